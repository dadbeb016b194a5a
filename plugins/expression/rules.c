/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/rules.h"
#include "plugins/expression/zeros.h"

#include <string.h>

/* pi = 0x1.921fb54442d18p+1 + 1.2247e-16, e = 0x1.5bf0a8b145769p+1 + 1.4457e-16 */
near_constant rules_pi(void) { return (near_constant){IMP_PI_LOWER, 0x1.2p-53}; }

near_constant rules_e(void) { return (near_constant){0x1.5bf0a8b145769p+1, 0x1.5p-53}; }

static const operation *at(const builder *b, uint16_t x) { return &b->operations[x]; }

static uint16_t unary(builder *b, opcode code, uint16_t x)
{
    return builder_operate(b, code, x, 0, 0);
}

static uint16_t ordered(builder *b, opcode code, uint16_t x, uint16_t y)
{
    return x <= y ? builder_operate(b, code, x, y, 0) : builder_operate(b, code, y, x, 0);
}

/* The constant x op y. */
static near_constant joined(builder *b, opcode code, near_constant x, near_constant y)
{
    return at(b, builder_operate(b, code, builder_constant(b, x), builder_constant(b, y), 0))->k;
}

/* --- Sums ------------------------------------------------------------------------------------- */

static uint16_t negate(builder *b, uint16_t x)
{
    const operation *o = at(b, x);
    near_constant k = o->k;
    k.value = -k.value;
    switch (o->code) {
    case OP_CONSTANT:
        return builder_constant(b, k);
    case OP_NEGATE:
        return o->operand[0];
    case OP_SCALE:
        return builder_with_constant(b, OP_SCALE, o->operand[0], k);
    default:
        return unary(b, OP_NEGATE, x);
    }
}

/* x + k, the ks of x + k + k joined. */
static uint16_t shift(builder *b, uint16_t x, near_constant k)
{
    const operation *o = at(b, x);
    if (o->code == OP_SHIFT) return shift(b, o->operand[0], joined(b, OP_ADD, o->k, k));
    if (k.value == 0 && k.error == 0) return x;
    return builder_with_constant(b, OP_SHIFT, x, k);
}

static uint16_t add(builder *b, uint16_t x, uint16_t y)
{
    const operation *p = at(b, x), *q = at(b, y);
    if (p->code == OP_CONSTANT && q->code == OP_CONSTANT)
        return builder_operate(b, OP_ADD, x, y, 0);
    if (q->code == OP_CONSTANT) return shift(b, x, q->k);
    if (p->code == OP_CONSTANT) return shift(b, y, p->k);
    return ordered(b, OP_ADD, x, y);
}

static uint16_t subtract(builder *b, uint16_t x, uint16_t y)
{
    return x == y ? builder_number(b, 0) : add(b, x, negate(b, y));
}

/* --- Products --------------------------------------------------------------------------------- */

static uint16_t scale(builder *b, uint16_t x, near_constant k)
{
    const operation *o = at(b, x);
    if (k.error == 0 && k.value == 0) return builder_number(b, 0);
    if (k.error == 0 && k.value == 1) return x;
    if (o->code == OP_SCALE) return scale(b, o->operand[0], joined(b, OP_MULTIPLY, o->k, k));
    if (o->code == OP_NEGATE) return scale(b, o->operand[0], (near_constant){-k.value, k.error});
    if (k.error == 0 && k.value == -1) return negate(b, x);
    return builder_with_constant(b, OP_SCALE, x, k);
}

static uint16_t square(builder *b, uint16_t x)
{
    const operation *o = at(b, x);
    if (o->code == OP_CONSTANT) return builder_operate(b, OP_MULTIPLY, x, x, 0);
    if (o->code == OP_NEGATE || o->code == OP_ABS) return square(b, o->operand[0]);
    if (o->code == OP_HYPOT) {
        uint16_t y = o->operand[1];
        return add(b, square(b, o->operand[0]), square(b, y));
    }
    return unary(b, OP_SQUARE, x);
}

/* x = base^n, n >= 1. */
static int32_t whole_power(const builder *b, uint16_t x, uint16_t *base)
{
    const operation *o = at(b, x);
    bool is_power = o->code == OP_SQUARE || (o->code == OP_POWER_N && o->n > 0);
    *base = is_power ? o->operand[0] : x;
    return o->code == OP_SQUARE ? 2 : is_power ? o->n : 1;
}

/* The highest whole power that is handled separately. */
#define WHOLE_MAX 1000000000

/* x x is a square, and so on: the range of a power takes into account that its factors are equal.
 */
static uint16_t multiply(builder *b, uint16_t x, uint16_t y)
{
    const operation *p = at(b, x), *q = at(b, y);
    uint16_t x_base, y_base;
    if (p->code == OP_CONSTANT && q->code == OP_CONSTANT)
        return builder_operate(b, OP_MULTIPLY, x, y, 0);
    if (q->code == OP_CONSTANT) return scale(b, x, q->k);
    if (p->code == OP_CONSTANT) return scale(b, y, p->k);
    int32_t n = whole_power(b, x, &x_base), m = whole_power(b, y, &y_base);
    if (x_base != y_base || n + m > WHOLE_MAX) return ordered(b, OP_MULTIPLY, x, y);
    return n + m == 2 ? square(b, x_base) : builder_power_n(b, x_base, n + m);
}

static uint16_t divide(builder *b, uint16_t x, uint16_t y)
{
    if (!builder_is_constant(b, y) || builder_is_constant(b, x))
        return builder_operate(b, OP_DIVIDE, x, y, 0);
    return scale(b, x, joined(b, OP_DIVIDE, near_exact(1), at(b, y)->k));
}

/* --- Powers and roots ------------------------------------------------------------------------- */

/* sqrt(x^2) is |x|, and a distance has rates where a square root has none. */
static uint16_t square_root(builder *b, uint16_t x)
{
    const operation *o = at(b, x);
    if (o->code == OP_SQUARE) return unary(b, OP_ABS, o->operand[0]);
    if (o->code != OP_ADD) return unary(b, OP_SQRT, x);
    const operation *p = at(b, o->operand[0]), *q = at(b, o->operand[1]);
    if (p->code == OP_SQUARE && q->code == OP_SQUARE)
        return ordered(b, OP_HYPOT, p->operand[0], q->operand[0]);
    return unary(b, OP_SQRT, x);
}

/* x^n by repeated products, each exact or enclosed. */
static uint16_t constant_power_n(builder *b, uint16_t x, int32_t n)
{
    uint16_t product = x;
    for (int32_t k = 1; k < n; ++k) product = builder_operate(b, OP_MULTIPLY, product, x, 0);
    return product;
}

static uint16_t power_n(builder *b, uint16_t x, int32_t n)
{
    if (n == 0) return builder_number(b, 1);
    if (n == 1) return x;
    if (n == 2) return square(b, x);
    if (n == -1) return divide(b, builder_number(b, 1), x);
    if (builder_is_constant(b, x) && n > 0 && n <= 64) return constant_power_n(b, x, n);
    return builder_power_n(b, x, n);
}

static uint16_t power_k(builder *b, uint16_t x, near_constant k)
{
    bool is_whole = k.error == 0 && fabs(k.value) <= WHOLE_MAX && floor(k.value) == k.value;
    if (is_whole) return power_n(b, x, (int32_t)k.value);
    if (k.error == 0 && k.value == 0.5) return square_root(b, x);
    return builder_with_constant(b, OP_POWER_K, x, k);
}

/* k^x = exp(x log k), k > 0. */
static uint16_t power_of_constant(builder *b, near_constant k, uint16_t x)
{
    near_constant e = rules_e();
    if (k.value == e.value && k.error == e.error) return unary(b, OP_EXP, x);
    if (!(k.value - k.error > 0))
        return builder_refuse(b, "the base of a varying exponent is %g, must be > 0", k.value);
    uint16_t log_k = unary(b, OP_LOG, builder_constant(b, k));
    return unary(b, OP_EXP, scale(b, x, at(b, log_k)->k));
}

static uint16_t power(builder *b, uint16_t x, uint16_t y)
{
    const operation *p = at(b, x), *q = at(b, y);
    if (q->code == OP_CONSTANT) return power_k(b, x, q->k);
    if (p->code == OP_CONSTANT) return power_of_constant(b, p->k, y);
    return builder_operate(b, OP_POWER, x, y, 0);
}

static uint16_t log_by_base(builder *b, uint16_t x, double base)
{
    return divide(b, unary(b, OP_LOG, x), unary(b, OP_LOG, builder_number(b, base)));
}

/* Where y is 0 the result is |x|, so it jumps at the edge of y <= 0 as it does inside, unless x is
 * 0 there. */
static uint16_t copysign_of(builder *b, uint16_t x, uint16_t y)
{
    if (b->whole[y].lo >= 0) return unary(b, OP_ABS, x);
    if (b->whole[y].hi < 0) return negate(b, unary(b, OP_ABS, x));
    if (vanishes_with(b, x, y)) return builder_operate(b, OP_COPYSIGN, x, y, 0);
    return builder_refuse(b, "copysign(x, y) jumps where y changes sign, unless x is seen to be 0 "
                             "there, as in copysign(abs(y)^p, y)");
}

/* --- All of them ------------------------------------------------------------------------------ */

/* op(op(a, b), c) ... */
static uint16_t in_turn(builder *b, opcode code, const uint16_t *argument, size_t count)
{
    uint16_t x = argument[0];
    for (size_t k = 1; k < count; ++k) x = ordered(b, code, x, argument[k]);
    return x;
}

static uint16_t minimum(builder *b, uint16_t x, uint16_t y) { return ordered(b, OP_MIN, x, y); }

static uint16_t lerp(builder *b, uint16_t x, uint16_t y, uint16_t t)
{
    return add(b, x, multiply(b, t, subtract(b, y, x)));
}

static uint16_t exp2_of(builder *b, uint16_t x)
{
    return builder_is_constant(b, x) ? power_k(b, builder_number(b, 2), at(b, x)->k)
                                     : power_of_constant(b, near_exact(2), x);
}

uint16_t rules_apply(builder *b, int which, const uint16_t *a, size_t count)
{
    switch (which) {
    case MEANING_NEGATE:
        return negate(b, a[0]);
    case MEANING_ADD:
        return add(b, a[0], a[1]);
    case MEANING_SUBTRACT:
        return subtract(b, a[0], a[1]);
    case MEANING_MULTIPLY:
        return multiply(b, a[0], a[1]);
    case MEANING_DIVIDE:
        return divide(b, a[0], a[1]);
    case MEANING_POWER:
        return power(b, a[0], a[1]);
    case MEANING_SQUARE:
        return square(b, a[0]);
    case MEANING_SQRT:
        return square_root(b, a[0]);
    case MEANING_LOG2:
        return log_by_base(b, a[0], 2);
    case MEANING_LOG10:
        return log_by_base(b, a[0], 10);
    case MEANING_EXP2:
        return exp2_of(b, a[0]);
    case MEANING_MIN:
        return in_turn(b, OP_MIN, a, count);
    case MEANING_MAX:
        return in_turn(b, OP_MAX, a, count);
    case MEANING_HYPOT:
        return count == 2 ? ordered(b, OP_HYPOT, a[0], a[1])
                          : builder_operate(b, OP_HYPOT3, a[0], a[1], a[2]);
    case MEANING_CLAMP:
        return minimum(b, in_turn(b, OP_MAX, a, 2), a[2]);
    case MEANING_LERP:
        return lerp(b, a[0], a[1], a[2]);
    case MEANING_COPYSIGN:
        return copysign_of(b, a[0], a[1]);
    default:
        return builder_operate(b, (opcode)(which - MEANING_OPERATION), a[0], count > 1 ? a[1] : 0,
                               0);
    }
}
