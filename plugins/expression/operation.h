/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_OPERATION_H
#define PLUGINS_EXPRESSION_OPERATION_H

#include "plugins/common/near.h"

#include <stdbool.h>

/* One operation of a formula
 * ==========================
 * A formula becomes a list of operations. Each takes at most three values, named by their indices,
 * and for some codes a number, and computes one value. A value is either a model, which holds over
 * a region, or a point, which is a number known within an error. This header defines the meaning of
 * each operation. */

typedef enum opcode {
    OP_CONSTANT, /* k */
    OP_VARIABLE, /* never run: values 0, 1, ... are the variables */
    OP_NEGATE,   /* -x */
    OP_ADD,      /* x + y */
    OP_MULTIPLY, /* x y */
    OP_DIVIDE,   /* x / y, y != 0 */
    OP_SHIFT,    /* x + k */
    OP_SCALE,    /* x k */
    OP_SQUARE,   /* x^2 */
    OP_POWER_N,  /* x^n; x != 0 if n < 0 */
    OP_POWER_K,  /* x^k; x >= 0, x > 0 if k < 0 */
    OP_POWER,    /* x^y; x >= 0, x > 0 if y < 0 */
    OP_ABS,
    OP_SQRT,
    OP_CBRT, /* the real root: negative for x < 0 */
    OP_EXP,
    OP_LOG,
    OP_SIN,
    OP_COS,
    OP_TAN,
    OP_ASIN,
    OP_ACOS,
    OP_ATAN,
    OP_SINH,
    OP_COSH,
    OP_TANH,
    OP_MIN,
    OP_MAX,
    OP_ATAN2,    /* the angle of the point (y, x), not (0, 0): x comes second */
    OP_HYPOT,    /* sqrt(x^2 + y^2) */
    OP_HYPOT3,   /* sqrt(x^2 + y^2 + z^2) */
    OP_COPYSIGN, /* |x| if y >= 0, else -|x|; x is 0 wherever y is */
    OP_COUNT
} opcode;

typedef struct operation {
    opcode code;
    int32_t n;           /* of OP_POWER_N */
    uint16_t operand[3]; /* indices of x, y, z; 0 where there is none */
    near_constant k;
} operation;

/* Returns how many operands operations of this code have. */
int opcode_operands(opcode code);

/* The constant as a model. */
imp_model near_model(near_constant k);

/* The operation on models; operands are indices into `values`. */
imp_model operation_model(const operation *o, const imp_model *values);

/* The operation on points: |exact result - value| <= error for all exact operands within
 * their errors. An infinite error: nothing is known. */
near_constant operation_point(const operation *o, const near_constant *values);

/* Whether the operation is undefined for all values of its operands. */
bool operation_is_undefined(const operation *o, const imp_model *values);

#endif
