/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_BUILDER_H
#define PLUGINS_EXPRESSION_BUILDER_H

#include "expression.h"
#include "expression_operation.h"

/* Building the list of operations
 * ===============================
 * The parser asks for operations, the builder answers with the index of their value. On the way
 * constants are computed, equal operations become one, and some are replaced by others
 * that are closer or cheaper: x x by a square, sqrt(x^2 + y^2) by a distance. Rewriting
 * is free to use any identity of real numbers, as bounds are about those.
 *
 * Beside each operation stands a model of its value over the whole domain. It tells what is
 * undefined everywhere, and which signs are known.
 *
 * What cannot be built is refused: `fault` says why, once, and from then on every answer is 0, an
 * index like any other. Who asks looks at `fault` when done. */

typedef struct builder {
    operation operations[EXPRESSION_OPERATIONS_MAX];
    imp_model whole[EXPRESSION_OPERATIONS_MAX];
    size_t count;
    uint16_t index_of_hash[2 * EXPRESSION_OPERATIONS_MAX]; /* or FREE_PLACE */
    char fault[160];                                       /* empty: none */
} builder;

/* Values 0 ... count - 1, count > 0, are the variables; whole[k] says what each may be. */
void builder_begin(builder *b, const imp_model *whole, size_t count);

uint16_t builder_number(builder *b, double k);
uint16_t builder_constant(builder *b, near_constant k);

bool builder_is_constant(const builder *b, uint16_t x);

/* An operation, unless it is of constants or there is one like it already; y and z are 0 where the
 * code has fewer operands. */
uint16_t builder_operate(builder *b, opcode code, uint16_t x, uint16_t y, uint16_t z);
uint16_t builder_with_constant(builder *b, opcode code, uint16_t x, near_constant k);
uint16_t builder_power_n(builder *b, uint16_t x, int32_t n);

/* Says what is at fault, if nothing was yet; answers 0. */
uint16_t builder_refuse(builder *b, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
