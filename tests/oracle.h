/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_ORACLE_H
#define TESTS_ORACLE_H

#include <stdbool.h>
#include <stdint.h>

#include <mpfi.h>

#include <impinge/model.h>

/* What model arithmetic is judged by
 * ==================================
 * Every operation of <impinge/model.h> beside its exact meaning, which MPFI computes in
 * intervals of ORACLE_BITS bits. A claim counts as refuted only when the interval of the exact
 * value lies wholly outside: never because of the oracle's own rounding. */

#define ORACLE_BITS 240

/* --- Random numbers that replay from a seed ----------------------------------- */

typedef struct dice {
    uint64_t state;
} dice;

uint64_t dice_bits(dice *d);
double dice_unit(dice *d);                                 /* in [0, 1) */
double dice_between(dice *d, double lo, double hi);        /* uniform */
double dice_magnitude(dice *d, double least, double most); /* 2^x, x uniform, either sign */
unsigned dice_below(dice *d, unsigned n);

/* --- Operations ------------------------------------------------------------------ */

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

double operation_constant(const operation *op, dice *d); /* one of its k */

/* --- Exact points of a region, exact values of a quadratic ------------------------- */

/* s in [-1, 1]^3, doubles: corners, centres of sides, and anything else. */
void oracle_place(dice *d, double s[3]);

/* The quadratic part of m at s. */
void oracle_quadratic(mpfi_ptr value, const imp_model *m, const mpfi_t s[3]);

/* --- Claims ---------------------------------------------------------------------------- */

/* Finite where it has to be, ordered, no NaN, zero where it does not depend. */
bool model_is_well_formed(const imp_model *m);

/* Is `value` surely farther than m->e from the quadratic at s, or surely outside [lo, hi]? */
bool quadratic_is_refuted(const imp_model *m, const mpfi_t s[3], mpfi_srcptr value);
bool range_is_refuted(double lo, double hi, mpfi_srcptr value);

/* All fields, in hexadecimal, to a static buffer that eight calls share. */
const char *model_text(const imp_model *m);

/* IMPINGE_TEST_MULTIPLIER times n. */
int trials(int n);

/* A seed of its own for each trial; IMPINGE_TEST_SEED in the environment makes others. */
uint64_t trial_seed(int trial);

#endif
