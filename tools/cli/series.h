/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SERIES_H
#define TOOLS_CLI_SERIES_H

#include "tools/cli/arguments.h"

/* solve --refine G1,G2,...: one answer for each gamma, from one search. */

/* Options of solve for several answers: --each (each.h) and --refine. */
extern const option options_series[];

/* Returns the gamma at *text, which is moved after it and a comma; NAN: there is none that is above
 * 0 and below `before`. */
double series_next_gamma(const char **text, double before);

/* Complains about options that exclude each other. */
exit_status series_check(const arguments *args);

/* Prints all answers of --refine. The exit status is that of the last. */
exit_status series_answer(imp_scene *scene, const arguments *args);

#endif
