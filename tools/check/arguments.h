/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ARGUMENTS_H
#define TOOLS_CHECK_ARGUMENTS_H

#include "tools/check/subject.h"

/* Checks that create does not read past its arguments and keeps no pointer to them. The values are
 * those that the host makes from the stage. Each array ends before a page that cannot be read, and
 * none of them can be read after create has returned. */
void arguments_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                     check_answer *answer);

#endif
