/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_DOMAIN_H
#define TOOLS_CHECK_DOMAIN_H

#include "tools/check/subject.h"

/* Compares the domain with the stated one, if any. Without one, ends that almost meet are noted, as
 * those of a period written as 6.28. */
void domain_check(const subject *s, uint64_t *random, double effort);

#endif
