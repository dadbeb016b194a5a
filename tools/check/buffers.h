/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_BUFFERS_H
#define TOOLS_CHECK_BUFFERS_H

#include "tools/check/subject.h"

/* Checks that nothing is written outside of the outputs or into the inputs, that no error is
 * written if none is requested, and that nothing is read or written past the end of any array: each
 * ends before a page that cannot be accessed. The effort has no influence. */
void buffers_check(const subject *s, uint64_t *random, double effort);

#endif
