/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/turned_form.h"

#include "plugins/expression/rules.h"

/* What operations depend on: bit j for variable j. */
typedef struct dependence {
    uint8_t of[EXPRESSION_OPERATIONS_MAX];
} dependence;

/* Operands come before what is computed of them. */
static void find_dependence(const builder *b, dependence *d)
{
    for (size_t k = 0; k < b->count; ++k) {
        const operation *o = &b->operations[k];
        d->of[k] = o->code == OP_VARIABLE ? (uint8_t)(1u << k) : 0;
        for (int i = 0; i < opcode_operands(o->code); ++i) d->of[k] |= d->of[o->operand[i]];
    }
}

/* Takes a shift by a number off. */
static uint16_t without_shift(const builder *b, uint16_t x, double *shift)
{
    const operation *o = &b->operations[x];
    *shift = 0;
    if (o->code != OP_SHIFT || o->k.error != 0) return x;
    *shift = o->k.value;
    return o->operand[0];
}

enum { DEPTH = 16 };

static uint16_t product(builder *b, uint16_t x, uint16_t y)
{
    const uint16_t both[2] = {x, y};
    return rules_apply(b, MEANING_MULTIPLY, both, 2);
}

static uint16_t number(builder *b, near_constant k)
{
    return builder_constant(b, (near_constant){fabs(k.value), k.error});
}

/* x or -x. */
static uint16_t without_sign(builder *b, uint16_t x)
{
    const operation o = b->operations[x];
    if (o.code == OP_NEGATE) return without_sign(b, o.operand[0]);
    if (o.code == OP_CONSTANT) return number(b, o.k);
    if (o.code == OP_SCALE) return product(b, number(b, o.k), without_sign(b, o.operand[0]));
    return x;
}

/* Finds R, but for its sign, in the product x of R and the wave. */
static bool factor(builder *b, uint16_t x, uint16_t wave, int depth, uint16_t *radius)
{
    const operation o = b->operations[x];
    uint16_t rest;
    if (x == wave) return *radius = builder_number(b, 1), true;
    if (depth == 0) return false;
    if (o.code == OP_NEGATE) return factor(b, o.operand[0], wave, depth - 1, radius);
    if (o.code == OP_SCALE && factor(b, o.operand[0], wave, depth - 1, &rest))
        return *radius = product(b, number(b, o.k), rest), true;
    for (int k = 0; k < 2 && o.code == OP_MULTIPLY; ++k)
        if (factor(b, o.operand[k], wave, depth - 1, &rest))
            return *radius = product(b, rest, without_sign(b, o.operand[!k])), true;
    return false;
}

/* Whether x and y are the products of one R, but for signs, and these waves. */
static bool are_products(builder *b, const uint16_t x[2], uint16_t wave, uint16_t other,
                         uint16_t *radius)
{
    uint16_t of_y;
    return factor(b, x[0], wave, DEPTH, radius) && factor(b, x[1], other, DEPTH, &of_y) &&
           *radius == of_y;
}

/* Finds the sine of what k is the cosine of; 0: there is none. */
static uint16_t sine_beside(const builder *b, uint16_t k)
{
    for (size_t j = 1; j < b->count; ++j)
        if (b->operations[j].code == OP_SIN &&
            b->operations[j].operand[0] == b->operations[k].operand[0])
            return (uint16_t)j;
    return 0;
}

enum { WAVES_MOST = 8 };

static bool find_along(builder *b, const dependence *d, size_t count, const uint16_t out[3],
                       turned_form *f)
{
    const int i = (f->along + 1) % 3, j = (f->along + 2) % 3;
    const uint16_t x[2] = {without_shift(b, out[i], &f->center[i]),
                           without_shift(b, out[j], &f->center[j])};
    f->center[f->along] = 0;
    f->height = out[f->along];
    for (size_t k = 0, waves = 0; k < count && waves < WAVES_MOST; ++k) {
        if (b->operations[k].code != OP_COS) continue;
        const uint16_t cosine = (uint16_t)k, sine = sine_beside(b, cosine);
        f->angle = b->operations[k].operand[0];
        const uint8_t around = d->of[f->angle];
        if (sine == 0 || (around != 1 && around != 2)) continue;
        ++waves;
        f->around = around == 1 ? 0 : 1;
        const uint8_t others = (uint8_t) ~(3 ^ around);
        if ((d->of[f->height] & others) != 0) continue;
        if (!are_products(b, x, cosine, sine, &f->radius) &&
            !are_products(b, x, sine, cosine, &f->radius))
            continue;
        dependence of_all;
        find_dependence(b, &of_all);
        if ((of_all.of[f->radius] & others) == 0) return true;
    }
    return false;
}

/* What is added may come to the limit of operations, which is no fault of the texts. */
bool turned_form_find(builder *b, const uint16_t out[3], turned_form *found)
{
    dependence d;
    const size_t count = b->count;
    bool is_found = false;
    find_dependence(b, &d);
    for (int along = 2; along >= 0 && !is_found; --along) {
        *found = (turned_form){.along = along};
        is_found = find_along(b, &d, count, out, found) && b->fault[0] == '\0';
    }
    b->fault[0] = '\0';
    return is_found;
}
