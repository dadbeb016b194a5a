/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_STEPS_H
#define TOOLS_PROOF_STEPS_H

#include "tools/proof/formula.h"

/* A formula as a list of steps, each from earlier ones: reader.c makes it from the texts and
 * formula.c computes it. The first steps are the variables. */

typedef enum step_kind {
    STEP_NUMBER,
    STEP_CONSTANT, /* computed from numbers: in formulas that have been read */
    STEP_PI,
    STEP_E,
    STEP_VARIABLE,
    STEP_NEGATE,
    STEP_ADD,
    STEP_SUBTRACT,
    STEP_MULTIPLY,
    STEP_DIVIDE,
    STEP_POWER,
    STEP_MIN,
    STEP_MAX,
    STEP_ANGLE,
    STEP_LENGTH,
    STEP_COPYSIGN,
    STEP_FUNCTION
} step_kind;

enum { STEPS_MAX = 16384 };

typedef struct step {
    step_kind kind;
    int operand[3], count; /* earlier steps; of STEP_VARIABLE, its index */
    double number;
    ld_interval constant;
    unsigned uses;    /* bit j: it depends on variable j */
    bool is_total;    /* it has a value for all values of the variables */
    bool is_tight;    /* its interval is its range already */
    bool is_narrowed; /* by formula_jets_about: it is a coordinate, or what uses it is not linear */
    jet_function *function;
} step;

struct formula {
    int count, out[3];
    jet *value;            /* of each step */
    step steps[STEPS_MAX]; /* while it is read; then only `count` of them are there */
};

/* Computes a step that depends on no variable. False: it depends on one, or has no value. */
bool formula_constant(formula *f, int which, ld_interval *value);

/* Reads one part of a text, as formula_read_part. */
bool reader_read_part(const formula_scope *scope, const char *text, formula *f,
                      formula_range ranges[FORMULA_VARIABLES], char *fault, size_t size);

/* Reads the texts. False: `fault` says why. */
bool reader_read(const formula_scope *scope, const char *const text[3], formula *f, char *fault,
                 size_t size);

#endif
