/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_STATE_H
#define TOOLS_CHECK_STATE_H

#include "tools/check/subject.h"

/* Checks that eval, rate, include, apply, rigid, distance, symmetry and tube change nothing that
 * outlives the call: neither the plugin's static data, nor the instance or other memory on the
 * heap. A cache may give right results to one thread and wrong ones to two, and comparing results
 * would not show it. Data that is computed once, in the first calls, is allowed. */
void state_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                 check_answer *answer);

#endif
