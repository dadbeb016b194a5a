/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_RENEWAL_H
#define TOOLS_CHECK_RENEWAL_H

#include "tools/check/subject.h"

/* Checks that an instance that renew refilled gives the same results, bit for bit, as a new one of
 * the same values: of changed ones, and then of those of the stage. Both keep no pointer to
 * them. */
void renewal_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                   check_answer *answer);

#endif
