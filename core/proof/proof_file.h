/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_FILE_H
#define CORE_PROOF_PROOF_FILE_H

#include "core/broad_phase/candidates.h"
#include "core/proof/proof_tree.h"

/* Writing certificates
 * ====================
 * A certificate states a claim in formulas and holds the trees that prove it (CERTIFICATE.md). */

/* A point of a surface; the piece is 0 where the surface is not divided. */
typedef struct proof_point {
    size_t body, surface, piece;
    double u, v;
} proof_point;

typedef struct proof_claim {
    const char *verdict; /* one word, what the program answered */
    double apart;        /* no points of two bodies are nearer than this; >= 0, length */
    double from, to;     /* at no time from `from` to `to`, both included */
    bool has_points;     /* the following are claimed, too */
    proof_point point[2];
    double t, within; /* at time t the two points are at most this far apart; length */
} proof_claim;

/* What the file is written from: a search's candidate pairs, and the log of its steps. */
typedef struct proof_search {
    const candidate_list *list;
    const proof_log *log;
} proof_search;

/* Writes a certificate. `stated`: lines that name the sources, each with its newline; NULL: none.
 * Fails with IMP_ERROR_MEMORY, or as a plugin fails that is asked for a formula. */
imp_code proof_file_write(const imp_scene *scene, const proof_search *search,
                          const proof_claim *claim, const char *stated, const proof_sink *to,
                          imp_error *error);

#endif
