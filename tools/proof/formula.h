/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_FORMULA_H
#define TOOLS_PROOF_FORMULA_H

#include <stddef.h>

#include "tools/proof/jet.h"

/* The stated formula of a surface or a map
 * =====================================
 * Three texts, for x, y and z, read and computed without the code that makes plugins from formulas,
 * because that code is under test: a separate reader, no rewriting, jets of intervals.
 *
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } power
 *   power    = operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * Numbers stand for the nearest double; names are the variables, the constants given, pi, e and
 * functions. The language is that of the types that take formulas as text; `impinge info formula`
 * lists it. */

/* The most that a formula has. */
enum { FORMULA_VARIABLES = 5 };

typedef struct formula_scope {
    const char *variables; /* a letter each: "uvt" */
    size_t count;          /* constants */
    const char *const *name;
    const double *value;
} formula_scope;

typedef struct formula formula;

/* NULL: `fault` says why. The caller frees the formula. */
formula *formula_read(const formula_scope *scope, const char *const text[3], char *fault,
                      size_t size);
void formula_free(formula *f);

/* The range of a variable in a part of a text: ends may be infinite. */
typedef struct formula_range {
    bool is_said;
    ld_interval lo, hi;
} formula_range;

/* Returns the next part of a text as types state it (imp_surface_type.formula: ranges, definitions
 * and three formulas, parts divided by '|'), or NULL after the last. */
const char *formula_next_part(const char *text);

/* Reads the first part of the text, and the ranges of its variables, in their order. NULL: `fault`
 * says why. The caller frees the formula. */
formula *formula_read_part(const formula_scope *scope, const char *text,
                           formula_range ranges[FORMULA_VARIABLES], char *fault, size_t size);

/* x, y, z from jets of the variables. Not thread-safe: the formula stores intermediate values. */
void formula_jets(formula *f, const jet *variables, jet out[3]);

/* Like formula_jets, with room for the values of all formula_steps(f) steps. */
int formula_steps(const formula *f);
bool formula_depends(const formula *f, int variable);
void formula_drop_values(formula *f); /* formula_jets may not be called after it */
void formula_jets_in(const formula *f, const jet *variables, jet *value, jet out[3]);

/* The variables over a box, at a point of it, and from the point into the box. */
typedef struct formula_boxes {
    const jet *box, *centre; /* of the latter no second derivatives are needed */
    const ld_interval *offset;
    bool is_first;    /* false: `value` is that of another call with the formula, from which only */
    unsigned changed; /* these variables differ, a bit for each */
} formula_boxes;

/* Like formula_jets_in, over the box and at the point, with room for twice as many steps. The
 * values of each step are narrowed by jet_narrow, so that long formulas lose little. */
void formula_jets_about(const formula *f, const formula_boxes *given, jet *value, jet out[3],
                        jet out_centre[3]);

#endif
