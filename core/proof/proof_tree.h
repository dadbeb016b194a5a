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
};

/* Takes bytes of a file in order. */
typedef struct proof_sink {
    void (*write)(void *context, const void *bytes, size_t size);
    void *context;
} proof_sink;

typedef struct proof_trees proof_trees;

/* Reads the log, which must outlive the result; NULL: no memory. */
proof_trees *proof_trees_new(const proof_log *log);
void proof_trees_free(proof_trees *trees);

/* Writes the tree of a candidate pair over the times [lo, hi]. `rests`: nothing moves, and the
 * search examined one moment in place of all times. */
void proof_trees_write(const proof_trees *trees, uint32_t candidate, double lo, double hi,
                       bool rests, const proof_sink *to);

#endif
