/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_FILE_H
#define TOOLS_CHECK_FILE_H

#include "check_answer.h"

/* What can be asked of a plugin's file before any of its types. */

/* The table of dynamic symbols has one of its own, impinge_plugin. */
void exports_check(const char *file, check_answer *answer);

/* Ids that nobody knows get no factory. */
void factories_check(const char *file, check_answer *answer);

#endif
