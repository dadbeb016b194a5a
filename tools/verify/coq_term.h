/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_COQ_TERM_H
#define TOOLS_VERIFY_COQ_TERM_H

#include <stdint.h>
#include <stdio.h>

#include "tools/proof/steps.h"

/* Steps of a formula as terms of Coq's real numbers */

/* Writes a double exactly. */
void coq_put_number(FILE *to, double x);

/* A stage and what its variables and constants are called. */
typedef struct writer {
    FILE *to;
    const formula *f;
    const char *variables; /* a letter each */
    size_t first;          /* number of its first constant that is known as an interval */
    size_t clock;          /* number of the constant that t is; SIZE_MAX: none, t is a variable */
} writer;

/* Whether a step is a constant that is known as an interval. */
static inline bool term_is_range(const step *s)
{
    return s->kind == STEP_CONSTANT && s->constant.lo != s->constant.hi;
}

/* Whether Coq's `interval` knows this step. */
bool term_is_known(const formula *f, const step *s);

/* Writes a step, all of whose operands are known. */
void term_put(const writer *w, int which);

#endif
