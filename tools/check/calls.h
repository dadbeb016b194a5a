/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_CALLS_H
#define TOOLS_CHECK_CALLS_H

#include "tools/check/subject.h"

/* One call of each pure callback
 * ==============================
 * With arguments drawn at random, and results thrown away: for checks of what calls do besides. A
 * callback that the type lacks is not called. */

enum { PURE_CALLS = 8 };

void pure_call(const subject *s, size_t which, uint64_t *random);

/* "eval", "rate", "include", ... */
const char *pure_call_name(const subject *s, size_t which);

#endif
