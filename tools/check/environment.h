/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_ENVIRONMENT_H
#define TOOLS_CHECK_ENVIRONMENT_H

#include <impinge/impinge.h>

#include "tools/check/answer.h"

/* Each call, from create to destroy, leaves alone what belongs to the whole thread or process:
 * rounding, subnormals, traps and x87 precision; errno; standard output; working directory, umask,
 * signal mask and locale; and it leaves no thread behind. */
void environment_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                       check_answer *answer);

#endif
