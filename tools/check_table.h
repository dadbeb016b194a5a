/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_TABLE_H
#define TOOLS_CHECK_TABLE_H

#include "check_subject.h"

/* What is asked of create, through values as a user writes them. */

/* Each parameter at the ends of its range is taken, or refused with a reason; just outside, as NaN,
 * as infinity and as text it is refused; so is a parameter that does not exist. `text` is a stage
 * that works, as "sphere radius=2". */
void parameters_check(imp_registry *registry, const imp_type_info *type, const char *text,
                      check_answer *answer);

/* Making, asking and destroying instances leaves no memory behind; nor does being refused. */
void memory_check(imp_registry *registry, const imp_type_info *type, const char *text,
                  check_answer *answer);

/* The parameter's value as it stands in the stage. Free it. NULL: it does not, or no memory. */
char *stage_value(const char *text, const char *parameter);

/* The stage with the parameter's value replaced, or added. Free it. NULL: no memory. */
char *stage_with(const char *text, const char *parameter, const char *value);

#endif
