/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PURITY_H
#define TOOLS_CHECK_PURITY_H

#include "check_subject.h"

/* What the ABI asks of every call, whatever it computes. Effort makes no difference. */

/* The same answer, bit for bit: called again, one point at a time, by four threads at once, and
 * from another instance of the same parameters. */
void determinism_check(const subject *s, uint64_t *random, double effort);

/* Rounding mode, subnormals, traps and errno are after each call as they were before. */
void environment_check(const subject *s, uint64_t *random, double effort);

/* Nothing is written outside of the outputs, nor into the inputs; no error is written when none is
 * asked for. */
void buffers_check(const subject *s, uint64_t *random, double effort);

#endif
