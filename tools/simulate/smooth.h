/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_SMOOTH_H
#define TOOLS_SIMULATE_SMOOTH_H

#include "tools/simulate/impact.h"

/* Impulses of one contact without friction
 * ========================================
 * The sizes of the normal impulses at its points, by Signorini's law (impact.h) with the targets of
 * the points: a linear complementarity problem. The relative motion along one normal has three
 * dimensions (one velocity, two rates of tilting), so that three points suffice to carry what any
 * number of points does (Caratheodory). All sets of up to three points are tried, and the one that
 * breaks the law least is taken: it breaks it by rounding. */
void smooth_impulses(const impact_body *bodies, const impact_contact *c,
                     double impulse[CONTACT_POINTS]);

#endif
