/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/builder.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define HASH_SIZE (2 * EXPRESSION_OPERATIONS_MAX)
#define FREE_PLACE UINT16_MAX

uint16_t builder_refuse(builder *b, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (b->fault[0] == '\0') vsnprintf(b->fault, sizeof b->fault, format, arguments);
    va_end(arguments);
    return 0;
}

/* --- Equal operations ------------------------------------------------------------------------- */

static bool is_same(const operation *p, const operation *q)
{
    return p->code == q->code && p->n == q->n && p->operand[0] == q->operand[0] &&
           p->operand[1] == q->operand[1] && p->operand[2] == q->operand[2] &&
           p->k.value == q->k.value && p->k.error == q->k.error;
}

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static size_t hash_of(const operation *o)
{
    uint64_t parts[] = {(uint64_t)o->code, (uint64_t)o->n,      o->operand[0],      o->operand[1],
                        o->operand[2],     bits_of(o->k.value), bits_of(o->k.error)};
    uint64_t hash = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; ++i) {
        hash = (hash ^ parts[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return (size_t)(hash % HASH_SIZE);
}

/* The place of an equal operation, or the free place where it belongs. The table is never more
 * than half full. */
static size_t find_place(const builder *b, const operation *o)
{
    size_t place = hash_of(o);
    while (b->index_of_hash[place] != FREE_PLACE &&
           !is_same(&b->operations[b->index_of_hash[place]], o))
        place = (place + 1) % HASH_SIZE;
    return place;
}

static uint16_t find_or_add(builder *b, const operation *o, const imp_model *whole)
{
    size_t place = find_place(b, o);
    if (b->fault[0] != '\0') return 0;
    if (b->index_of_hash[place] != FREE_PLACE) return b->index_of_hash[place];
    if (b->count == EXPRESSION_OPERATIONS_MAX)
        return builder_refuse(b, "more than %d operations", EXPRESSION_OPERATIONS_MAX);
    b->operations[b->count] = *o;
    b->whole[b->count] = *whole;
    b->index_of_hash[place] = (uint16_t)b->count;
    return (uint16_t)b->count++;
}

/* --- Constants -------------------------------------------------------------------------------- */

uint16_t builder_constant(builder *b, near_constant k)
{
    operation o = {.code = OP_CONSTANT, .k = k};
    o.k.value += 0.0; /* -0 becomes 0: there is one zero */
    imp_model whole = near_model(k);
    return find_or_add(b, &o, &whole);
}

uint16_t builder_number(builder *b, double k) { return builder_constant(b, near_exact(k)); }

bool builder_is_constant(const builder *b, uint16_t x)
{
    return b->operations[x].code == OP_CONSTANT;
}

/* Below this, products and quotients may have lost digits to underflow. */
#define EXACT_MIN 0x1p-900

/* Is r = x op y exactly? Lemma: r is the rounded sum, and s - x, y - (s - x) ... are exact
 * (Knuth); or fma shows the rest that a product or quotient has, unless it underflows. */
static bool is_exact_result(opcode code, double x, double y, double r)
{
    double back = r - x;
    switch (code) {
    case OP_ADD:
        return r - r == 0 && (x - (r - back)) + (y - back) == 0;
    case OP_MULTIPLY:
        return x == 0 || y == 0 || (fabs(r) > EXACT_MIN && fma(x, y, -r) == 0);
    case OP_DIVIDE:
        return x == 0 || (fabs(x) > EXACT_MIN && fabs(r) > EXACT_MIN && fma(r, y, -x) == 0);
    case OP_SQRT:
        return x == 0 || (x > EXACT_MIN && fma(r, r, -x) == 0);
    default:
        return false;
    }
}

static double rounded_result(opcode code, double x, double y)
{
    switch (code) {
    case OP_ADD:
        return x + y;
    case OP_MULTIPLY:
        return x * y;
    case OP_DIVIDE:
        return x / y;
    case OP_SQRT:
        return sqrt(x);
    default:
        return 0;
    }
}

/* Exact results stay exact, so that 2/4 is the same as 0.5. */
static near_constant fold(const builder *b, const operation *o, const imp_model *result)
{
    near_constant x = b->operations[o->operand[0]].k, y = b->operations[o->operand[1]].k;
    double r = rounded_result(o->code, x.value, y.value);
    bool exact_operands = x.error == 0 && (opcode_operands(o->code) < 2 || y.error == 0);
    if (exact_operands && is_exact_result(o->code, x.value, y.value, r)) return near_exact(r);
    return near_of(*result);
}

static bool has_constant_operands(const builder *b, const operation *o)
{
    for (int i = 0; i < opcode_operands(o->code); ++i)
        if (!builder_is_constant(b, o->operand[i])) return false;
    return true;
}

/* --- Operations ------------------------------------------------------------------------------- */

void builder_begin(builder *b, const imp_model *whole, size_t count)
{
    b->count = 0;
    b->fault[0] = '\0';
    memset(b->index_of_hash, 0xff, sizeof b->index_of_hash);
    for (size_t k = 0; k < count; ++k) {
        operation o = {.code = OP_VARIABLE, .n = (int32_t)k};
        find_or_add(b, &o, &whole[k]);
    }
}

static uint16_t refuse_undefined(builder *b, const operation *o)
{
    const imp_model *x = &b->whole[o->operand[0]];
    switch (o->code) {
    case OP_DIVIDE:
        return builder_refuse(b, "division by 0");
    case OP_ATAN2:
        return builder_refuse(b, "atan2(0, 0) is undefined");
    case OP_POWER_N:
        return builder_refuse(b, "0 to the power of %d is undefined", o->n);
    case OP_POWER_K:
    case OP_POWER:
        return builder_refuse(b,
                              "this power is undefined everywhere: its base is in [%g, %g], and "
                              "only whole constant exponents take such a base",
                              x->lo, x->hi);
    default:
        return builder_refuse(b, "%s is undefined everywhere: its argument is in [%g, %g]",
                              o->code == OP_SQRT   ? "sqrt"
                              : o->code == OP_LOG  ? "log"
                              : o->code == OP_ASIN ? "asin"
                                                   : "acos",
                              x->lo, x->hi);
    }
}

/* Adds the operation, unless its operands are constants or an equal one exists. */
static uint16_t builder_append(builder *b, const operation *o)
{
    if (b->fault[0] != '\0') return 0;
    if (operation_is_undefined(o, b->whole)) return refuse_undefined(b, o);
    imp_model whole = operation_model(o, b->whole);
    if (!has_constant_operands(b, o)) return find_or_add(b, o, &whole);
    if (!(whole.e < INFINITY)) return builder_refuse(b, "this constant overflows");
    return builder_constant(b, fold(b, o, &whole));
}

uint16_t builder_operate(builder *b, opcode code, uint16_t x, uint16_t y, uint16_t z)
{
    operation o = {.code = code, .operand = {x, y, z}};
    return builder_append(b, &o);
}

uint16_t builder_with_constant(builder *b, opcode code, uint16_t x, near_constant k)
{
    operation o = {.code = code, .operand = {x, 0, 0}, .k = k};
    return builder_append(b, &o);
}

uint16_t builder_power_n(builder *b, uint16_t x, int32_t n)
{
    operation o = {.code = OP_POWER_N, .n = n, .operand = {x, 0, 0}};
    return builder_append(b, &o);
}
