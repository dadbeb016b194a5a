/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_TREE_H
#define CORE_PROOF_PROOF_TREE_H

#include "core/proof/proof_log.h"

/* The trees of a certificate
 * ==========================
 * A tree divides the cell of a candidate pair, its domains and times, until an axis separates the
 * two surfaces in each part. It is written in prefix order (CERTIFICATE.md). */

enum {
    PROOF_OP_SPLIT = 0, /* + 2 side + along: both halves follow, the lower first */
    PROOF_OP_TIME = 4,  /* + 2 bytes, k: split at k / 65536 of the time; earlier part first */
    PROOF_OP_AXIS = 5,  /* leaf, + 6 bytes: an axis */
    PROOF_OP_SAME = 6,  /* leaf, with the axis of the leaf before, if that had one */
    PROOF_OP_ALONE = 7, /* leaf, without an axis */
    PROOF_OP_CLOCK = 8, /* + a count, a clock, + 2 bytes, k: split at k / 65536 of its values */
};

/* Takes bytes of a file in order. */
typedef struct proof_sink {
    void (*write)(void *context, const void *bytes, size_t size);
    void *context;
} proof_sink;

typedef struct proof_trees proof_trees;

/* Returns the number at k / 65536 of a cell, as the program that reads the file computes it. */
static inline double proof_place(double lo, double hi, unsigned k)
{
    return lo + (hi - lo) * (k / 65536.0);
}

/* Copies a tree that was written over the times [lo, hi] of a query to a cell of the times [from,
 * to]: splits that are not in the cell are left out. Answers false if the bytes are no tree. */
bool proof_tree_copy(const uint8_t *tree, size_t size, double lo, double hi, double from, double to,
                     const proof_sink *sink);

/* Reads the log, which must outlive the result; NULL: no memory. */
proof_trees *proof_trees_new(const proof_log *log);
void proof_trees_free(proof_trees *trees);

/* Writes the tree of a candidate pair over the times [lo, hi]. `rests`: nothing moves, and the
 * search examined one moment in place of all times. */
void proof_trees_write(const proof_trees *trees, uint32_t candidate, double lo, double hi,
                       bool rests, const proof_sink *to);

#endif
