/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_REQUEST_H
#define TOOLS_CHECK_REQUEST_H

#include "tools/check/list.h"

/* What the user asks of a type
 * ============================
 * Parameters, formula and domain of the command line are read before the checks run, so that their
 * errors are not reported as the plugin's. */

/* Why the request cannot be read, which is not a bug of the plugin; empty: it can be read. */
typedef struct check_misreading {
    char stage[1000], formula[1000], domain[1000];
} check_misreading;

/* Tries, in a child, the parameters in the task's first stage (NULL: none were given) and its
 * formula and domain, of the type of that name, or of all in the file. *shared is from
 * child_memory. */
void check_try(const check_task *task, double seconds, check_misreading *shared);

#endif
