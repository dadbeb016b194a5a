/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ORACLE_H
#define TESTS_SUPPORT_ORACLE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include <mpfi.h>

#include <impinge/model.h>

/* What model arithmetic is judged by
 * ==================================
 * Every operation of <impinge/model.h> beside its exact meaning, which MPFI computes in
 * intervals of ORACLE_BITS bits. A claim counts as refuted only when the interval of the exact
 * value lies wholly outside: never because of the oracle's own rounding. */

#define ORACLE_BITS 240

/* --- Random numbers, beside those of suite.h -------------------------------------------------- */

double oracle_magnitude(uint64_t *state, double least, double most); /* +-2^k, k uniform */
unsigned oracle_below(uint64_t *state, unsigned n);                  /* 0 ... n - 1 */

/* What trial number `trial` starts from. */
uint64_t oracle_seed(int trial);

/* --- Operations ------------------------------------------------------------------------------- */

/* r = op(x, y; k), or false where op is undefined at (some point of) x, y. */
typedef bool (*oracle_exact)(mpfi_ptr r, mpfi_srcptr x, mpfi_srcptr y, double k);

typedef struct operation {
    const char *name;
    int arity; /* 1: y is not used */
    imp_model (*model)(imp_model x, imp_model y, double k);
    oracle_exact exact;
    imp_interval (*interval)(imp_interval x, imp_interval y, double k); /* NULL: has none */
    const double *constants; /* what k may be, ended by NAN; NULL: k is not used */
} operation;

extern const operation operations[];
extern const int operation_count;

double operation_constant(const operation *op, uint64_t *state); /* one of its k */

/* --- Exact points of a region, exact values of a quadratic ------------------------------------ */

/* s in [-1, 1]^3, doubles: corners, centres of sides, and anything else. */
void oracle_place(uint64_t *state, double s[3]);

/* The quadratic part of m at s. */
void oracle_quadratic(mpfi_ptr value, const imp_model *m, const mpfi_t s[3]);

/* --- Claims ----------------------------------------------------------------------------------- */

/* Finite where it has to be, ordered, no NaN, zero where it does not depend. */
bool model_is_well_formed(const imp_model *m);

/* Is `value` surely farther than m->e from the quadratic at s, or surely outside [lo, hi]? */
bool quadratic_is_refuted(const imp_model *m, const mpfi_t s[3], mpfi_srcptr value);
bool range_is_refuted(double lo, double hi, mpfi_srcptr value);

/* All fields, in hexadecimal, to a static buffer that eight calls share. */
const char *model_text(const imp_model *m);

#endif
