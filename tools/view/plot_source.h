/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PLOT_SOURCE_H
#define TOOLS_VIEW_PLOT_SOURCE_H

#include <jansson.h>

#include "tools/view/gap.h"
#include "tools/view/plot.h"
#include "tools/view/subject.h"

/* Plots of the distance over time, or of the pairs that benchmarks took. */

/* Plots the brackets as a band. The contact is marked, or else the nearest approach, and the
 * required distance (0: none). False: no memory. */
bool plot_of_gap(plot *p, const gap_profile *gap, const subject *what, double required);

/* Plots one set of the output of `bench --json`: mean pairs of each method over the numbers at the
 * end of the cases' names. Complains. */
exit_status plot_of_bench(plot *p, const json_t *set, const char *name, const char *verb);

#endif
