/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "check_view.h"

#include <float.h>
#include <math.h>

#include "check_polynomial.h"

/* --- The region ----------------------------------------------------------------------------- */

/* [-1, 1] where that is exact; else (lo - c) / d to (hi - c) / d, rounded outward. */
static void find_whole(frame *f, int j)
{
    const branch_claims *k = f->claims;
    const span lo = span_of(k->where.lo[j]), hi = span_of(k->where.hi[j]);
    const span c = span_of(k->c[j]), d = span_of(k->d[j]);
    if (k->d[j] == 0)
        f->whole[j] = span_of(0);
    else if (span_is(span_sub(c, d), lo.lo) && span_is(span_add(c, d), hi.hi))
        f->whole[j] = span_make(-1, 1);
    else
        f->whole[j] = span_div(span_sub(span_make(lo.lo, hi.hi), c), d);
    f->is_exact[j] = span_is(span_add(c, span_mul(d, span_of(f->whole[j].lo))), lo.lo) &&
                     span_is(span_add(c, span_mul(d, span_of(f->whole[j].hi))), hi.hi);
}

frame frame_make(const branch_field *field, const branch_claims *claims)
{
    frame f = {.field = field, .claims = claims};
    for (int j = 0; j < field->n; ++j) find_whole(&f, j);
    return f;
}

/* --- Views ---------------------------------------------------------------------------------- */

/* How far p may lie beyond the region where s is in f->whole, which is within a few roundings of
 * the exact ends. */
static long double overhang(const frame *f, int j)
{
    const branch_claims *c = f->claims;
    const long double size = fabsl((long double)c->c[j]) + c->d[j];
    return f->is_exact[j] ? 0 : 8 * LDBL_EPSILON * size + LDBL_MIN;
}

/* p = c + d s, no farther out than that. False: it may be outside of the region. */
static bool number_of(const frame *f, int j, const jet *normalized, long double beyond, jet *p)
{
    const branch_claims *c = f->claims;
    const span where = span_make(c->where.lo[j], c->where.hi[j]);
    *p = jet_scale(normalized, span_of(c->d[j]));
    p->v = span_add(span_of(c->c[j]), p->v);
    const bool within = span_is_within(p->v, where);
    p->v = span_meet(p->v, span_add(where, span_plus_minus(beyond)));
    return within;
}

/* x, y, z where s is there. False: some of it may be outside of the region. */
static bool values_at(const frame *f, const span where[BOX_DIMS], bool strictly,
                      jet normalized[BOX_DIMS], jet out[3])
{
    jet p[BOX_DIMS];
    bool within = true;
    for (int j = 0; j < f->field->n; ++j) {
        normalized[j] = jet_variable(f->field->n, j, where[j]);
        within &= number_of(f, j, &normalized[j], strictly ? 0 : overhang(f, j), &p[j]);
    }
    f->field->jets(f->field->context, p, normalized, out);
    return within;
}

/* The same, and how far they are off the quadratic. */
static bool look_at(const frame *f, const span where[BOX_DIMS], const bool off_wanted[3],
                    jet out[3], jet off[3])
{
    jet normalized[BOX_DIMS];
    const bool within = values_at(f, where, false, normalized, out);
    for (int i = 0; i < 3; ++i) {
        if (!off_wanted[i]) continue;
        const jet quadratic = polynomial_jet(&f->claims->model[i], 0, normalized);
        off[i] = jet_sub(&out[i], &quadratic);
    }
    return within;
}

/* The middle, or 0 where that is nearly it: there, p is c exactly. */
static long double middle_of(span x)
{
    const long double m = span_mid(x);
    return fabsl(m) < 0x1p-4L * (x.hi - x.lo) ? 0 : m;
}

void frame_look(const frame *f, const span x[BOX_DIMS], const bool off_wanted[3], view *v)
{
    for (int j = 0; j < f->field->n; ++j) {
        v->middle[j] = span_of(middle_of(x[j]));
        v->offset[j] = span_sub(x[j], v->middle[j]);
    }
    look_at(f, x, off_wanted, v->box, v->off_box);
    v->has_point = look_at(f, v->middle, off_wanted, v->centre, v->off_centre);
}

bool frame_is_in_range(const frame *f, const span x[BOX_DIMS], int i)
{
    const imp_model *g = &f->claims->model[i];
    jet normalized[BOX_DIMS], out[3];
    bool exact = true;
    for (int j = 0; j < f->field->n; ++j) exact &= f->is_exact[j];
    if (exact) return false;
    values_at(f, x, true, normalized, out);
    return span_is_within(out[i].v, span_make(g->lo, g->hi));
}
