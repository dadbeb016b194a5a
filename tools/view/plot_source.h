/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PLOT_SOURCE_H
#define TOOLS_VIEW_PLOT_SOURCE_H

#include <jansson.h>

#include "tools/view/gap.h"
#include "tools/view/plot.h"
#include "tools/view/subject.h"

/* What is plotted: distance over time, or the pairs that benchmarks took. */

/* The brackets as a band. The contact is marked, or else the nearest approach, and what is
 * required; 0: a distance is not required. False: no memory. */
bool plot_of_gap(plot *p, const gap_profile *gap, const subject *what, double required);

/* One set of what `bench --json` printed: mean pairs of each method over what the names of the
 * cases end with. Complains. */
exit_status plot_of_bench(plot *p, const json_t *set, const char *name, const char *verb);

#endif
