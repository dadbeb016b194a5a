/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_FORMULA_H
#define TOOLS_CHECK_FORMULA_H

#include <stddef.h>

#include "check_jet.h"

/* What a surface or a map is said to be
 * =====================================
 * Three texts, for x, y and z, read and computed without any of the code that makes plugins from
 * formulas, as it is the one under test: a reader of its own, no rewriting, jets of spans.
 *
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } power
 *   power    = operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * Numbers stand for the nearest double; names are the variables, the constants given, pi, e and
 * functions. The language is that of the types that take formulas as text; sdk/README tells it. */

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

/* x, y, z from jets of the variables. Not for several threads: the formula keeps what it computes
 * on the way. */
void formula_jets(formula *f, const jet *variables, jet out[3]);

#endif
