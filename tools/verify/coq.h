/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_COQ_H
#define TOOLS_VERIFY_COQ_H

#include "tools/verify/walk.h"

/* Leaves as goals for Coq
 * =======================
 * While a certificate is proved, some of its leaves are drawn at random, and written as theorems
 * for Coq's `interval` tactic: a second opinion by other intervals. */

typedef struct coq coq;

/* Has the walk draw `count` leaves; the same ones for the same seed. NULL: no memory. The caller
 * frees the result. */
coq *coq_begin(walk *w, size_t count, uint64_t seed);

/* Writes them after the walk, whose statement must be there still, and returns how many there are.
 * *known: leaves that could be drawn. Others are of formulas that `interval` does not know or that
 * are too long, or are parted by no axis. */
size_t coq_write(const coq *q, FILE *to, uint64_t *known);

void coq_free(coq *q);

#endif
