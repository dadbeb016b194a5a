/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_TABLE_H
#define TOOLS_CHECK_TABLE_H

#include "tools/check/subject.h"

/* Checks of create, with values as a user writes them. */

/* Each parameter at the ends of its range is accepted, or rejected with a reason. Just outside, as
 * NaN, as infinity and as text it is rejected, and so is a parameter that does not exist. `text` is
 * a stage that works, as "sphere radius=2". */
void parameters_check(imp_registry *registry, const imp_type_info *type, const char *text,
                      check_answer *answer);

/* Creating, using and destroying instances does not leak memory; nor does a rejected creation. */
void memory_check(imp_registry *registry, const imp_type_info *type, const char *text,
                  check_answer *answer);

#endif
