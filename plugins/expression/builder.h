/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_BUILDER_H
#define PLUGINS_EXPRESSION_BUILDER_H

#include "plugins/expression/expression.h"
#include "plugins/expression/operation.h"

/* Building the list of operations
 * ===============================
 * The parser adds operations, and the builder returns the index of their value. The builder folds
 * constants, merges equal operations, and replaces some by tighter or cheaper ones: x x by a
 * square, sqrt(x^2 + y^2) by a distance. It may use any identity of real numbers, because the
 * bounds are about real numbers.
 *
 * Each operation is stored with a model of its value over the whole domain. The model shows which
 * operations are undefined everywhere, and which signs are known.
 *
 * On an error `fault` gets the reason of the first one, and from then on every result is 0, which
 * is a valid index. The caller checks `fault` at the end. */

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

/* Adds an operation, unless its operands are constants or an equal one exists; y and z are 0 where
 * the code has fewer operands. */
uint16_t builder_operate(builder *b, opcode code, uint16_t x, uint16_t y, uint16_t z);
uint16_t builder_with_constant(builder *b, opcode code, uint16_t x, near_constant k);
uint16_t builder_power_n(builder *b, uint16_t x, int32_t n);

/* Records the error, if it is the first; returns 0. */
uint16_t builder_refuse(builder *b, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
