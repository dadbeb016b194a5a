/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_FILE_H
#define CORE_PROOF_PROOF_FILE_H

#include "core/broad_phase/candidates.h"
#include "core/proof/proof_tree.h"

/* Certificates: what is claimed, in formulas, and the trees that prove it (CERTIFICATE.md) */

/* A point of a surface; the piece is 0 where the surface is not divided. */
typedef struct proof_point {
    size_t body, surface, piece;
    double u, v;
} proof_point;

typedef struct proof_claim {
    const char *verdict; /* one word, what the program answered */
    double apart;        /* nothing is nearer, >= 0; length */
    double from, to;     /* at any of these times, both included */
    bool has_points;
    proof_point point[2]; /* at time t are no farther apart than */
    double t, within;     /* this; length */
} proof_claim;

/* What a search has kept of itself. */
typedef struct proof_search {
    const candidate_list *list;
    const proof_log *log;
} proof_search;

/* Writes a certificate. `stated`: lines that name the sources, each with its end; NULL: none. */
imp_code proof_file_write(const imp_scene *scene, const proof_search *search,
                          const proof_claim *claim, const char *stated, const proof_sink *to,
                          imp_error *error);

#endif
