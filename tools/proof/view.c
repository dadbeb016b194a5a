/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/view.h"

#include <math.h>

#include "tools/proof/polynomial.h"

/* --- The region ------------------------------------------------------------------------------- */

/* [-1, 1] where that is exact; else (lo - c) / d to (hi - c) / d, rounded outward. */
static void find_whole(frame *f, int j)
{
    const branch_claims *k = f->claims;
    const ld_interval lo = ld_interval_of(k->where.lo[j]), hi = ld_interval_of(k->where.hi[j]);
    const ld_interval c = ld_interval_of(k->c[j]), d = ld_interval_of(k->d[j]);
    if (k->d[j] == 0)
        f->whole[j] = ld_interval_of(0);
    else if (ld_interval_is(ld_interval_sub(c, d), lo.lo) &&
             ld_interval_is(ld_interval_add(c, d), hi.hi))
        f->whole[j] = ld_interval_make(-1, 1);
    else
        f->whole[j] = ld_interval_div(ld_interval_sub(ld_interval_make(lo.lo, hi.hi), c), d);
}

frame frame_make(const branch_field *field, const branch_claims *claims)
{
    frame f = {.field = field, .claims = claims};
    for (int j = 0; j < field->n; ++j) find_whole(&f, j);
    return f;
}

/* --- Views ------------------------------------------------------------------------------------ */

/* p = c + d s, and the region's: s may lie beyond it, by the rounding of its ends, where nothing is
 * claimed. `point` is one of the region near s. The result contains it, so that the lines from
 * there to any such p are inside. */
static jet number_of(const frame *f, int j, const jet *normalized, long double point)
{
    const branch_claims *c = f->claims;
    jet p = jet_scale(normalized, ld_interval_of(c->d[j]));
    const ld_interval v = ld_interval_add(ld_interval_of(c->c[j]), p.v);
    const ld_interval at = ld_interval_of(point);
    const long double lo = v.lo > c->where.lo[j] ? v.lo : c->where.lo[j];
    const long double hi = v.hi < c->where.hi[j] ? v.hi : c->where.hi[j];
    p.v = lo <= hi ? ld_interval_hull(ld_interval_make(lo, hi), at) : at;
    return p;
}

/* How far the coordinates are off the claimed model's quadratic. */
static void subtract_quadratics(const frame *f, const jet normalized[BOX_DIMS],
                                const bool off_wanted[3], const jet values[3], jet off[3])
{
    for (int i = 0; i < 3; ++i) {
        if (!off_wanted[i]) continue;
        const jet quadratic = polynomial_jet(&f->claims->model[i], 0, normalized);
        off[i] = jet_sub(&values[i], &quadratic);
    }
}

/* The middle, or 0 where that is nearly it: there, p is c exactly. */
static long double middle_of(ld_interval x)
{
    const long double m = ld_interval_mid(x);
    return fabsl(m) < 0x1p-4L * (x.hi - x.lo) ? 0 : m;
}

/* The number of the region that is nearest to c + d m. At the ends of the region s is known only
 * within a few roundings, but the number is exact, and so is the claim about it. */
static long double number_near(const branch_claims *c, int j, long double m)
{
    const long double p = c->c[j] + c->d[j] * m;
    return p < c->where.lo[j] ? c->where.lo[j] : p > c->where.hi[j] ? c->where.hi[j] : p;
}

/* Parameter p, from -1 to 1 over the region. */
static ld_interval normalized_at(const branch_claims *c, int j, long double p)
{
    const ld_interval offset = ld_interval_sub(ld_interval_of(p), ld_interval_of(c->c[j]));
    if (c->d[j] == 0 || ld_interval_is(offset, 0)) return ld_interval_of(0);
    return ld_interval_div(offset, ld_interval_of(c->d[j]));
}

/* x, y, z at one point of the region, and how far they are off the quadratic. */
static void evaluate_point(const frame *f, const ld_interval x[BOX_DIMS], const bool off_wanted[3],
                           view *v)
{
    jet normalized[BOX_DIMS], p[BOX_DIMS];
    for (int j = 0; j < f->field->n; ++j) {
        v->point[j] = number_near(f->claims, j, middle_of(x[j]));
        v->middle[j] = normalized_at(f->claims, j, v->point[j]);
        normalized[j] = jet_variable(f->field->n, j, v->middle[j]);
        p[j] = jet_scale(&normalized[j], ld_interval_of(f->claims->d[j]));
        p[j].v = ld_interval_of(v->point[j]);
    }
    f->field->jets(f->field->context, p, normalized, v->centre);
    subtract_quadratics(f, normalized, off_wanted, v->centre, v->off_centre);
}

static void evaluate_box(const frame *f, const ld_interval x[BOX_DIMS], const bool off_wanted[3],
                         view *v)
{
    jet normalized[BOX_DIMS], p[BOX_DIMS];
    for (int j = 0; j < f->field->n; ++j) {
        normalized[j] = jet_variable(f->field->n, j, x[j]);
        p[j] = number_of(f, j, &normalized[j], v->point[j]);
        v->offset[j] = ld_interval_sub(x[j], v->middle[j]);
    }
    f->field->jets(f->field->context, p, normalized, v->box);
    subtract_quadratics(f, normalized, off_wanted, v->box, v->off_box);
}

void frame_evaluate(const frame *f, const ld_interval x[BOX_DIMS], const bool off_wanted[3],
                    view *v)
{
    evaluate_point(f, x, off_wanted, v);
    evaluate_box(f, x, off_wanted, v);
}
