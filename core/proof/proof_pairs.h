/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_PAIRS_H
#define CORE_PROOF_PROOF_PAIRS_H

#include "core/broad_phase/candidates.h"
#include "core/proof/proof_tree.h"

/* The trees of a search, by pairs of surfaces */

/* A search's candidate pairs, and the log of its steps. */
typedef struct proof_search {
    const candidate_list *list;
    const proof_log *log;
} proof_search;

/* Writes a number as bytes of seven bits, the lowest first; all but the last byte have the high bit
 * set. */
void proof_put_count(const proof_sink *to, size_t n);

/* Returns the order of the pieces in a candidate's clusters, one for each piece; NULL: it has
 * none. */
const uint32_t *proof_order(const candidate *c);

/* Writes such an order. */
void proof_put_order(const proof_sink *to, const uint32_t *order, size_t count);

/* Returns whether a candidate pair is of these surfaces of these bodies. */
bool proof_is_pair(const candidate_pair *p, const size_t body[2], const size_t at[2]);

/* Writes the tree of candidate pair `index` over the times [lo, hi] of its query. */
void proof_search_write(const proof_search *search, const proof_trees *trees, size_t index,
                        double lo, double hi, const proof_sink *to);

/* The pairs of one search of a scene, whose `put` is a proof_source's (proof_file.h). */
typedef struct proof_pairs {
    const imp_scene *scene;
    const proof_search *search;
    double from, to;
    proof_trees *trees;
    size_t next; /* candidate pair; these are in the order of the file */
} proof_pairs;

bool proof_pairs_begin(proof_pairs *p, const imp_scene *scene, const proof_search *search,
                       double from, double to); /* false: no memory */
void proof_pairs_end(proof_pairs *p);
void proof_pairs_put(void *context, const size_t body[2], const size_t at[2], const proof_sink *to);

#endif
