/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/zeros.h"

#include <string.h>

static bool is_exactly_0(const operation *o)
{
    return o->code == OP_CONSTANT && o->k.error == 0 && o->k.value == 0;
}

/* Is the operation 0 wherever its operands are that `zero` marks? A factor that is unbounded there,
 * as in y * (1/y), has unbounded rates in any case. */
static bool vanishes(const operation *o, const bool *zero)
{
    bool x = zero[o->operand[0]], y = zero[o->operand[1]];
    switch (o->code) {
    case OP_NEGATE:
    case OP_SCALE:
    case OP_SQUARE:
    case OP_ABS:
    case OP_SQRT:
    case OP_CBRT:
    case OP_SIN:
    case OP_TAN:
    case OP_ASIN:
    case OP_ATAN:
    case OP_SINH:
    case OP_TANH:
    case OP_DIVIDE:
    case OP_COPYSIGN:
        return x;
    case OP_POWER_N:
        return x && o->n > 0;
    case OP_POWER_K:
        return x && o->k.value - o->k.error > 0;
    case OP_MULTIPLY:
        return x || y;
    case OP_ADD:
    case OP_MIN:
    case OP_MAX:
    case OP_HYPOT:
        return x && y;
    case OP_HYPOT3:
        return x && y && zero[o->operand[2]];
    default:
        return false;
    }
}

/* y without factors that never vanish. */
static uint16_t bare(const builder *b, uint16_t y)
{
    while (b->operations[y].code == OP_NEGATE || b->operations[y].code == OP_SCALE)
        y = b->operations[y].operand[0];
    return y;
}

bool vanishes_with(const builder *b, uint16_t x, uint16_t y)
{
    bool zero[EXPRESSION_OPERATIONS_MAX];
    uint16_t root = bare(b, y);
    memset(zero, 0, x + 1u);
    for (size_t i = 0; i <= x; ++i)
        zero[i] = i == root || is_exactly_0(&b->operations[i]) || vanishes(&b->operations[i], zero);
    return zero[x];
}
