/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PROOF_PROOF_FILE_H
#define CORE_PROOF_PROOF_FILE_H

#include "core/proof/proof_pairs.h"

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
    /* For a claim about all values of the scene's parameters: lo and hi of each, and the values at
     * which the two points are. NULL: it is about the scene as it stands. */
    const double *ranges, *values;
} proof_claim;

/* Writes what follows the numbers of two surfaces, of bodies a < b (CERTIFICATE.md). It is called
 * in the order of the scene. */
typedef struct proof_source {
    void *context;
    void (*put)(void *context, const size_t body[2], const size_t at[2], const proof_sink *to);
} proof_source;

/* Writes a certificate. `stated`: lines that name the sources, each with its newline; NULL: none.
 * Fails with IMP_ERROR_MEMORY, or as a plugin fails that is asked for a formula. */
imp_code proof_file_write(const imp_scene *scene, const proof_source *trees,
                          const proof_claim *claim, const char *stated, const proof_sink *to,
                          imp_error *error);

#endif
