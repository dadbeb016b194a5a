/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "plugins/expression/coil_form.h"

#include <string.h>

/* --- Linear forms ----------------------------------------------------------------------------- */

/* scale (a u + b v) + shift, a and b exact. */
typedef struct linear_form {
    double a[2];
    near_constant scale, shift;
} linear_form;

/* Whether x y == z w, for exact doubles that neither overflow nor underflow. */
static bool is_same_product(double x, double y, double z, double w)
{
    const double p = x * y, q = z * w;
    if (p == 0 || q == 0) return (x == 0 || y == 0) && (z == 0 || w == 0);
    return p == q && fabs(p) > 0x1p-900 && fabs(p) < 0x1p900 && fma(x, y, -p) == fma(z, w, -q);
}

/* Whether p == x y, or s == x + y (Knuth), exactly. */
static bool is_product(double p, double x, double y) { return is_same_product(x, y, p, 1); }

static bool is_sum(double s, double x, double y)
{
    const double back = s - x;
    return s - s == 0 && (x - (s - back)) + (y - back) == 0;
}

/* Exact results stay exact. */
static near_constant times(near_constant x, near_constant y)
{
    const double p = x.value * y.value;
    if (x.error == 0 && y.error == 0 && is_product(p, x.value, y.value)) return near_exact(p);
    return near_of(imp_mul(near_model(x), near_model(y)));
}

static near_constant plus(near_constant x, near_constant y)
{
    const double s = x.value + y.value;
    if (x.error == 0 && y.error == 0 && is_sum(s, x.value, y.value)) return near_exact(s);
    return near_of(imp_add(near_model(x), near_model(y)));
}

static near_constant minus(near_constant x, near_constant y)
{
    return near_of(imp_sub(near_model(x), near_model(y)));
}

/* Precondition: x / y is asked only where y is surely not 0 (is_surely_not_0). */
static near_constant over(near_constant x, near_constant y)
{
    return near_of(imp_div(near_model(x), near_model(y)));
}

static bool is_surely_not_0(near_constant x) { return fabs(x.value) > 2 * x.error; }

static bool is_parallel(const double a[2], const double b[2])
{
    return is_same_product(a[0], b[1], a[1], b[0]);
}

/* *sum = x k + y l. False: that is no double. */
static bool exact_sum(double x, near_constant k, double y, near_constant l, double *sum)
{
    const near_constant all = plus(times(near_exact(x), k), times(near_exact(y), l));
    *sum = all.value;
    return all.error == 0;
}

/* How deep, and how many operations are looked at. */
enum { LOOKS = 4096 };

typedef struct search {
    const builder *b;
    int looks;
    coil_form *found;
    bool has_w;
    near_constant harmonic; /* p / kappa, once it is known */
    bool judges;            /* else w is looked for */
} search;

static bool linear_of(search *s, uint16_t x, linear_form *f);

static bool add_forms(const linear_form *f, const linear_form *g, linear_form *sum)
{
    const near_constant one = near_exact(1);
    sum->shift = plus(f->shift, g->shift);
    sum->scale = one;
    if (exact_sum(f->a[0], f->scale, g->a[0], g->scale, &sum->a[0]) &&
        exact_sum(f->a[1], f->scale, g->a[1], g->scale, &sum->a[1]))
        return true;
    if (f->a[0] != g->a[0] || f->a[1] != g->a[1]) return false;
    memcpy(sum->a, f->a, sizeof sum->a);
    sum->scale = plus(f->scale, g->scale);
    return true;
}

static bool linear_of_operation(search *s, const operation *o, linear_form *f)
{
    linear_form other;
    const near_constant k = o->k;
    switch (o->code) {
    case OP_NEGATE:
        if (!linear_of(s, o->operand[0], f)) return false;
        f->scale.value = -f->scale.value;
        f->shift.value = -f->shift.value;
        return true;
    case OP_SHIFT:
        if (!linear_of(s, o->operand[0], f)) return false;
        f->shift = plus(f->shift, k);
        return true;
    case OP_SCALE:
        if (!linear_of(s, o->operand[0], f)) return false;
        f->scale = times(f->scale, k);
        f->shift = times(f->shift, k);
        return true;
    case OP_ADD:
        if (!linear_of(s, o->operand[0], f) || !linear_of(s, o->operand[1], &other)) return false;
        {
            const linear_form first = *f;
            return add_forms(&first, &other, f);
        }
    default:
        return false;
    }
}

/* Only u and v, the first two variables, may occur. */
static bool linear_of(search *s, uint16_t x, linear_form *f)
{
    const operation *o = &s->b->operations[x];
    *f = (linear_form){{0, 0}, near_exact(1), near_exact(0)};
    if (s->looks-- <= 0) return false;
    if (o->code == OP_CONSTANT) return f->shift = o->k, true;
    if (o->code == OP_VARIABLE) return x < 2 ? f->a[x] = 1, true : false;
    return linear_of_operation(s, o, f);
}

/* --- The radius ------------------------------------------------------------------------------- */

/* Judges a wave: of some multiple of w, by whole turns where w is moved by 2 pi p / kappa. Lemma.
 * The argument c w + d of a sine or cosine is then moved by 2 pi c p / kappa, which is 2 pi (n +
 * e), n whole: what is moved by whole turns is the same, and 2 pi e is the motion of c w where w is
 * moved by e / (c p / kappa) times 2 pi p / kappa. */
static bool judge_wave(search *s, const linear_form *f)
{
    coil_form *c = s->found;
    if (f->a[0] == 0 && f->a[1] == 0) return true;
    if (!s->has_w) {
        memcpy(c->w, f->a, sizeof c->w);
        s->has_w = true;
    }
    if (!is_parallel(f->a, c->w)) return false;
    if (!s->judges) return true;
    const int j = fabs(c->w[0]) >= fabs(c->w[1]) ? 0 : 1;
    const near_constant ratio = over(near_exact(f->a[j]), near_exact(c->w[j]));
    const near_constant turns = times(times(f->scale, ratio), s->harmonic);
    const double whole = nearbyint(turns.value);
    const double off = imp_sum_up(fabs(turns.value - whole) + turns.error);
    if (!(fabs(whole) >= 1 && fabs(whole) < 0x1p20 && off < 0x1p-30)) return false;
    const double drift = imp_round_up(off / (0.5 * fabs(whole)));
    if (drift > c->drift) c->drift = drift;
    return true;
}

/* Whether an operation depends on u and v by waves alone, and on nothing else. */
static bool judge_radius(search *s, uint16_t x)
{
    const operation *o = &s->b->operations[x];
    linear_form f;
    if (s->looks-- <= 0) return false;
    if (o->code == OP_CONSTANT) return true;
    if (o->code == OP_VARIABLE) return false;
    if ((o->code == OP_SIN || o->code == OP_COS) && linear_of(s, o->operand[0], &f))
        return judge_wave(s, &f);
    for (int k = 0; k < opcode_operands(o->code); ++k)
        if (!judge_radius(s, o->operand[k])) return false;
    return true;
}

/* --- The form --------------------------------------------------------------------------------- */

/* Takes a shift by a number off. */
static uint16_t without_shift(const builder *b, uint16_t x, double *shift)
{
    const operation *o = &b->operations[x];
    *shift = 0;
    if (o->code != OP_SHIFT || o->k.error != 0) return x;
    *shift = o->k.value;
    return o->operand[0];
}

/* Finds R and the angle in R cos(angle) or R sin(angle). */
static bool split(const builder *b, uint16_t x, opcode wave, uint16_t *radius, uint16_t *angle)
{
    const operation *o = &b->operations[x];
    if (o->code != OP_MULTIPLY) return false;
    for (int k = 0; k < 2; ++k) {
        const operation *w = &b->operations[o->operand[k]];
        if (w->code != wave) continue;
        *angle = w->operand[0];
        *radius = o->operand[!k];
        return true;
    }
    return false;
}

/* d f along d, a direction of (u, v) with exact coordinates. */
static near_constant along(const linear_form *f, const double d[2])
{
    const near_constant u = times(near_exact(f->a[0]), near_exact(d[0])),
                        v = times(near_exact(f->a[1]), near_exact(d[1]));
    return times(f->scale, plus(u, v));
}

/* Finds p, kappa and rest. Along (b, -a) w stays; along (a, b) it grows by a^2 + b^2. */
static bool find_lead(coil_form *c, const linear_form *phi, const linear_form *zeta)
{
    const double stays[2] = {c->w[1], -c->w[0]};
    const near_constant turns = along(phi, stays),
                        grows = plus(times(near_exact(c->w[0]), near_exact(c->w[0])),
                                     times(near_exact(c->w[1]), near_exact(c->w[1])));
    if (!is_surely_not_0(turns) || !is_surely_not_0(grows)) return false;
    c->p = over(along(zeta, stays), turns);
    c->kappa = over(minus(along(zeta, c->w), times(c->p, along(phi, c->w))), grows);
    c->rest = minus(zeta->shift, times(c->p, phi->shift));
    return is_surely_not_0(c->p) && is_surely_not_0(c->kappa);
}

/* Whether phi and zeta are each given by a parameter of its own. */
static void find_around(coil_form *c, const linear_form *phi, const linear_form *zeta)
{
    c->around = -1;
    for (int j = 0; j < 2; ++j) {
        if (phi->a[!j] != 0 || zeta->a[j] != 0) continue;
        c->around = j;
        c->turning = times(phi->scale, near_exact(phi->a[j]));
    }
}

static bool find_along(const builder *b, const uint16_t out[3], int along_axis, bool is_mirrored,
                       coil_form *c)
{
    const int i = (along_axis + (is_mirrored ? 2 : 1)) % 3, j = 3 - along_axis - i;
    uint16_t angle[2], radius[2];
    linear_form phi, zeta;
    search s = {.b = b, .looks = LOOKS, .found = c};
    *c = (coil_form){.along = along_axis, .is_mirrored = is_mirrored};
    if (!split(b, without_shift(b, out[i], &c->center[i]), OP_COS, &radius[0], &angle[0]) ||
        !split(b, without_shift(b, out[j], &c->center[j]), OP_SIN, &radius[1], &angle[1]))
        return false;
    if (radius[0] != radius[1] || angle[0] != angle[1]) return false;
    c->radius = radius[0];
    if (!linear_of(&s, angle[0], &phi) || !linear_of(&s, out[along_axis], &zeta)) return false;
    if (!judge_radius(&s, c->radius) || !s.has_w || !find_lead(c, &phi, &zeta)) return false;
    find_around(c, &phi, &zeta);
    s.harmonic = over(c->p, c->kappa);
    s.judges = true;
    s.looks = LOOKS;
    return judge_radius(&s, c->radius);
}

bool coil_form_find(const builder *b, const uint16_t out[3], coil_form *found)
{
    for (int k = 0; k < 6; ++k)
        if (find_along(b, out, k / 2, k % 2 != 0, found)) return true;
    return false;
}
