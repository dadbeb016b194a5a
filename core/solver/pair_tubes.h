/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_TUBES_H
#define CORE_SOLVER_PAIR_TUBES_H

#include "core/solver/impact.h"

/* Pairs of tubes
 * ==============
 * Two surfaces that run around lines (imp_surface_type.tube) are as far apart as these are, less
 * both radii, if they lie outside each other. So whole surfaces are replaced by nodes that follow
 * their lines (node_tube), of which only u and t are cut. Once lines come nearer than both radii
 * anywhere, the tubes of both surfaces are opened: v is cut, too, and the halves follow the
 * surfaces. */

/* Whether both nodes are tubes around a line. */
static inline bool pair_has_tubes(const pair *p)
{
    return p->tubes == TUBES_CLOSED && p->a->ball > 0 && p->b->ball > 0;
}

/* Replaces the nodes of a pair of whole surfaces by tubes, if both have lines, or opens tubes if
 * that is due. Not where a proof is kept, whose verifier knows no tubes, nor for a box of values,
 * nor where gamma_clear is nearly gamma. *gamma, at which surfaces touch, becomes that at which
 * their lines count as touching. IMP_ERROR_PLUGIN: a callback breaks the ABI. */
imp_code pair_tubes_take(const impact *im, pair *p, double *gamma, imp_error *error);

/* Lets v be cut, too, of all tubes of the two surfaces, before a search ends for lack of
 * resolution: balls may reach farther than surfaces do. False: neither node is a tube that can be
 * cut so. */
bool pair_tubes_open(const impact *im, pair *p);

#endif
