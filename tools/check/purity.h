/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PURITY_H
#define TOOLS_CHECK_PURITY_H

#include "tools/check/subject.h"

/* The results are the same bit for bit: called again, one point at a time, by four threads at once,
 * and from another instance of the same parameters. The effort has no influence. */
void determinism_check(const subject *s, uint64_t *random, double effort);

/* Whether two subjects of one type give the same results bit for bit, nets and distances too; else
 * the first one's check fails, with the words of `when`. */
bool purity_are_alike(const subject *s, const subject *other, uint64_t *random, const char *when);

#endif
