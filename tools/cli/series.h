/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SERIES_H
#define TOOLS_CLI_SERIES_H

#include "tools/cli/arguments.h"

/* More than one answer from one search
 * ====================================
 * solve --each: the first contact of each two bodies, in order of time, each printed when it is
 * proved; then the bodies that stay clear, or were left undecided. solve --refine G1,G2,...: one
 * answer for each gamma. */

extern const option options_series[];

/* Whether either is asked for; complains of what does not go together. */
exit_status series_check(const arguments *args, bool *asked);

/* Prints all answers. The exit status is that of the whole. */
exit_status series_answer(imp_scene *scene, const arguments *args);

#endif
