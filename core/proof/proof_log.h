/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_LOG_H
#define CORE_PROOF_PROOF_LOG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What a search has done with its pairs, kept for a certificate
 * ==============================================================
 * A record says what became of a pair: it was made of another, its parent, by one step, and a test
 * along an axis left this part of its window. Records are only appended. None of it is trusted:
 * impinge-verify proves each leaf of the tree again, and the axes only say where to look
 * (CERTIFICATE.md). */

typedef enum proof_step {
    PROOF_ROOT,     /* a candidate pair; its parent is its index among these */
    PROOF_AGAIN,    /* the parent, tested once more */
    PROOF_SPAN,     /* the parent during a part of its window */
    PROOF_HALF = 8, /* + proof_half: half of one node */
} proof_step;

/* The step to a half of the node of a side (0 or 1), along u (0) or v (1); half 1 is above. */
static inline unsigned proof_half(int side, int along, int half)
{
    return PROOF_HALF + 4 * (unsigned)side + 2 * (unsigned)along + (unsigned)half;
}

typedef struct proof_record {
    double lo, hi; /* what is left of the window; lo > hi: nothing */
    uint32_t parent;
    int16_t axis[3]; /* any length; 0: none */
    uint8_t step;
} proof_record;

typedef struct proof_log {
    proof_record *at;
    size_t count, capacity;
    bool failed; /* memory ran out: nothing can be written */
} proof_log;     /* begins as {0}; proof_log_clear frees */

/* The logs of a query: for the contact or a violation, and for the minimum distance. */
typedef struct proof_logs {
    proof_log contact, distance;
} proof_logs;

/* Appends a record and returns its index. `axis` may have any length; NaN is no axis. */
uint32_t proof_log_add(proof_log *log, unsigned step, uint32_t parent, const double axis[3],
                       double lo, double hi);

void proof_log_clear(proof_log *log);

#endif
