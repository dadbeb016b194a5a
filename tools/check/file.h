/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_FILE_H
#define TOOLS_CHECK_FILE_H

#include "tools/check/answer.h"

/* Checks of a plugin's file that need none of its types. */

/* Checks that the plugin exports exactly one symbol of its own, impinge_plugin. */
void exports_check(const char *file, check_answer *answer);

/* Checks that the compiler left sums and products as they were written; a note where not. */
void build_check(const char *file, check_answer *answer);

/* Unknown ids get no factory. */
void factories_check(const char *file, check_answer *answer);

#endif
