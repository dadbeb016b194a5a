/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/patch_include.h"

#include "plugins/patch/patch_series.h"

#include <impinge/quad.h>
#include <stdlib.h>
#include <string.h>

/* Sums over the series, of all coordinates side by side. X here is X + c_t Y, at the region's
 * middle time; `size` is |X| + d_t |Y|, at least |X + t Y| at all its times. */
typedef struct patch_terms {
    imp_quad x[3][3];          /* X_kl, k + l <= 2 */
    imp_quad y[2][2];          /* Y_kl, k + l <= 1 */
    imp_quad rest;             /* of size, where k + l >= 3, and of d_t |Y|, where k + l = 2 */
    imp_quad size, speed;      /* of size, of |Y| */
    imp_quad along_u, along_v; /* of k^2 size, of l^2 size */
} patch_terms;

IMP_QUAD_INLINE void patch_collect(int n, int m, int lanes, const imp_quad *c, double middle,
                                   double half, patch_terms *terms)
{
    const imp_quad zero = {0};
    const int group = lanes / IMP_QUAD;
    imp_quad rest = zero, total = zero, speed = zero, along_u = zero, along_v = zero;
    imp_quad column[PATCH_SIDE_MAX];
    terms->x[1][0] = terms->x[0][1] = zero; /* a curve has m = 0 */
    terms->x[2][0] = terms->x[1][1] = terms->x[0][2] = zero;
    terms->y[0][0] = terms->y[1][0] = terms->y[0][1] = zero;
    PATCH_UNROLL
    for (int l = 0; l <= m; ++l) column[l] = zero;
    PATCH_UNROLL
    for (int k = 0; k <= n; ++k) {
        imp_quad row = zero;
        PATCH_UNROLL
        for (int l = 0; l <= m; ++l) {
            imp_quad x = c[(k * (m + 1) + l) * group], size = imp_quad_abs(x);
            if (lanes == 8) {
                imp_quad y = c[(k * (m + 1) + l) * group + 1], change = half * imp_quad_abs(y);
                x += middle * y;
                size = imp_quad_abs(x) + change;
                speed += imp_quad_abs(y);
                if (k + l <= 1) terms->y[k][l] = y;
                if (k + l == 2) rest += change;
            }
            if (k + l <= 2) terms->x[k][l] = x;
            if (k + l >= 3) rest += size;
            row += size;
            column[l] += size;
        }
        total += row;
        along_u += (double)(k * k) * row;
    }
    PATCH_UNROLL
    for (int l = 1; l <= m; ++l) along_v += (double)(l * l) * column[l];
    terms->rest = rest, terms->size = total, terms->speed = speed;
    terms->along_u = along_u, terms->along_v = along_v;
}

/* At least b s + q s^2 on [-1, 1]: its ends, and the vertex -b^2 / 4q, which is inside only if
 * |b| < 2|q| and then at most |b| / 2 from 0. */
IMP_QUAD_INLINE imp_quad patch_bow_upper(imp_quad b, imp_quad q)
{
    return imp_quad_max(q + imp_quad_abs(b), 0.5 * imp_quad_abs(b));
}

/* The numbers of imp_model, of all coordinates side by side. */
typedef struct patch_parts {
    imp_quad a, b[3], q[6], e, lo, hi, rate[3];
} patch_parts;

/* lo and hi from the quadratic and e. `size` bounds what the coefficients but a add up to; all
 * roundings here are within 16 ROUNDING of the magnitudes. */
IMP_QUAD_INLINE void patch_range(patch_parts *g, imp_quad size)
{
    const imp_quad uu = g->q[IMP_UU], vv = g->q[IMP_VV];
    const imp_quad up = patch_bow_upper(g->b[0], uu) + patch_bow_upper(g->b[1], vv);
    const imp_quad down = patch_bow_upper(g->b[0], -uu) + patch_bow_upper(g->b[1], -vv);
    const imp_quad cross = imp_quad_abs(g->b[2]) + imp_quad_abs(g->q[IMP_UV]) +
                           imp_quad_abs(g->q[IMP_UT]) + imp_quad_abs(g->q[IMP_VT]);
    const imp_quad margin =
        cross + g->e + 16 * ROUNDING * (imp_quad_abs(g->a) + size + cross + g->e);
    g->lo = g->a - (down + margin);
    g->hi = g->a + (up + margin);
}

static void patch_cut(imp_model *g, double lo, double hi)
{
    g->lo = imp_larger(g->lo, lo);
    g->hi = imp_smaller(g->hi, hi);
}

/* Models of the first `count` lanes: place + t drift + X + t Y.
 *
 * Lemma. Rounding in patch_collect, in a, in b_t: 8 ROUNDING (size + |c_t| speed) and, from place
 * and drift, 4 ROUNDING (|place| + (|c_t| + d_t) |drift|). SLACK covers the bounds' own. */
IMP_QUAD_INLINE patch_parts patch_assemble(const patch *f, int n, int m, int lanes,
                                           const imp_region *region, const imp_quad *c)
{
    const double middle = region->c[2], half = region->d[2], late = fabs(middle) + half;
    patch_terms sum;
    patch_collect(n, m, lanes, c, middle, half, &sum);
    const imp_quad place = imp_quad_load(f->place), drift = imp_quad_load(f->drift);
    const imp_quad centre = place + middle * drift;
    const imp_quad size = sum.size + fabs(middle) * sum.speed;
    const imp_quad far = imp_quad_abs(place) + late * imp_quad_abs(drift);
    imp_quad slip = imp_quad_load(f->noise) + 8 * ROUNDING * size;
    imp_quad reach = imp_quad_load(f->place_radius) + half * imp_quad_abs(drift);
    imp_quad slope_u = imp_quad_load(f->slope[0]), slope_v = imp_quad_load(f->slope[1]);
    patch_parts g = {.rate = {{0}}, .q = {{0}}};
    if (lanes == 8) {
        const imp_quad y = sum.y[0][0], noise_y = imp_quad_load(f->noise + 4);
        slip += late * noise_y;
        reach += late * imp_quad_load(f->drift_radius);
        slope_u += late * imp_quad_load(f->slope[0] + 4);
        slope_v += late * imp_quad_load(f->slope[1] + 4);
        g.rate[2] = (imp_quad_abs(drift + y) + (sum.speed - imp_quad_abs(y)) + noise_y +
                     8 * ROUNDING * (imp_quad_abs(drift) + sum.speed)) *
                    SLACK;
    }
    g.a = centre + (sum.x[0][0] - sum.x[2][0] - sum.x[0][2]);
    g.e = (sum.rest + slip + 4 * ROUNDING * far) * SLACK;
    g.b[0] = sum.x[1][0], g.b[1] = sum.x[0][1], g.b[2] = half * (drift + sum.y[0][0]);
    g.q[IMP_UU] = 2 * sum.x[2][0], g.q[IMP_VV] = 2 * sum.x[0][2], g.q[IMP_UV] = sum.x[1][1];
    g.q[IMP_UT] = half * sum.y[1][0], g.q[IMP_VT] = half * sum.y[0][1];
    g.rate[0] = imp_quad_min((sum.along_u + (double)(n * n) * slip) * (SLACK / region->d[0]),
                             slope_u * SLACK);
    g.rate[1] = imp_quad_min((sum.along_v + (double)(m * m) * slip) * (SLACK / region->d[1]),
                             slope_v * SLACK);
    patch_range(&g, size);
    reach = (reach + 8 * ROUNDING * far) * SLACK;
    g.lo = imp_quad_max(g.lo, centre - reach);
    g.hi = imp_quad_min(g.hi, centre + reach);
    return g;
}

IMP_QUAD_INLINE void patch_models(const patch *f, int n, int m, int lanes, const imp_region *region,
                                  const imp_quad *c, int count, imp_model *out)
{
    const patch_parts g = patch_assemble(f, n, m, lanes, region, c);
    PATCH_UNROLL
    for (int i = 0; i < count; ++i) {
        out[i].a = g.a[i], out[i].e = g.e[i], out[i].lo = g.lo[i], out[i].hi = g.hi[i];
        for (int j = 0; j < 3; ++j) out[i].b[j] = g.b[j][i], out[i].rate[j] = g.rate[j][i];
        for (int k = 0; k < 6; ++k) out[i].q[k] = g.q[k][i];
        out[i].depends = lanes == 8 ? 7 : 3, out[i].reserved = 0;
    }
}

IMP_QUAD_INLINE void patch_polynomial(const patch *f, int n, int m, int lanes,
                                      const imp_region *region, imp_model model[3])
{
    imp_quad c[PATCH_NUMBERS_MAX / IMP_QUAD], work[PATCH_NUMBERS_MAX / IMP_QUAD];
    patch_localize(f, n, m, lanes, region, c, work);
    patch_models(f, n, m, lanes, region, c, 3, model);
}

/* Makes the models of a patch of any degrees; fast for bicubic ones. */
IMP_QUAD_INLINE void patch_polynomial_of(const patch *f, const imp_region *region,
                                         imp_model model[3])
{
    const bool bicubic = f->degree[0] == 3 && f->degree[1] == 3;
    if (bicubic && f->lanes == 8)
        patch_polynomial(f, 3, 3, 8, region, model);
    else if (bicubic)
        patch_polynomial(f, 3, 3, 4, region, model);
    else
        patch_polynomial(f, f->degree[0], f->degree[1], f->lanes, region, model);
}

IMP_QUAD_WIDE static void patch_polynomial_wide(const patch *f, const imp_region *region,
                                                imp_model model[3])
{
    patch_polynomial_of(f, region, model);
}

/* A rational patch as (X + t Y) / W. Around g = c0 + t c1, near the middle of the region,
 *
 *   f = place + c0 + t (drift + c1) + ((X - c0 W) + t (Y - c1 W)) / W,
 *
 * exactly for any c0 and c1; the numerator is small, so that little is lost in the quotient. Lemma:
 * X - c0 W has the noise of both, and its two roundings add ROUNDING (|c0| |W| + |X - c0 W|), of
 * which patch_assemble has the second. */
IMP_QUAD_INLINE void patch_take_off(patch *f, imp_quad *series, int lane, double c)
{
    const size_t couples = patch_points(f->degree) * (size_t)(f->lanes / IMP_QUAD);
    double *radius = lane < 4 ? &f->place_radius[lane] : &f->drift_radius[lane - 4], weights = 0;
    for (size_t i = 0; i < couples; i += (size_t)(f->lanes / IMP_QUAD)) {
        double w = series[i + PATCH_W / IMP_QUAD][PATCH_W % IMP_QUAD];
        weights += fabs(w);
        series[i + (size_t)(lane / IMP_QUAD)][lane % IMP_QUAD] -= c * w;
    }
    f->noise[lane] += fabs(c) * (f->noise[PATCH_W] + 2 * ROUNDING * weights) * SLACK;
    *radius = (*radius + fabs(c) * f->most[PATCH_W]) * SLACK;
    for (int side = 0; side < 2; ++side)
        f->slope[side][lane] += fabs(c) * f->slope[side][PATCH_W] * SLACK;
}

/* Leaves X, Y and W alone, all about 0. */
static void patch_forget_motion(patch *f)
{
    memset(f->place, 0, sizeof f->place);
    memset(f->drift, 0, sizeof f->drift);
    memcpy(f->place_radius, f->most, sizeof f->place_radius);
    memcpy(f->drift_radius, f->most + 4, sizeof f->drift_radius);
}

static imp_model patch_quotient(const patch *f, int axis, const imp_region *region,
                                const imp_model *x, const imp_model *w, const double c[2])
{
    imp_model g = imp_div(*x, *w);
    imp_model start = imp_add(imp_num(f->place[axis]), imp_num(c[0]));
    imp_model speed = imp_add(imp_num(f->drift[axis]), imp_num(c[1]));
    g = imp_add(g, imp_add(start, imp_mul(speed, imp_param(region, 2))));
    double late = fabs(region->c[2]) + region->d[2];
    double centre = f->place[axis] + region->c[2] * f->drift[axis];
    double far = fabs(f->place[axis]) + late * fabs(f->drift[axis]);
    double reach = f->place_radius[axis] + late * f->drift_radius[axis] +
                   region->d[2] * fabs(f->drift[axis]) + 8 * ROUNDING * far;
    patch_cut(&g, centre - reach * SLACK, centre + reach * SLACK);
    return imp_model_finish(g);
}

/* What the quotients are made of: numerators x, y, z and W as models, and the c0 and c1 taken
 * off. */
typedef struct patch_fractions {
    imp_model x[4];
    double off[3][2];
} patch_fractions;

IMP_QUAD_INLINE void patch_fractions_at(const patch *f, int n, int m, int lanes,
                                        const imp_region *region, patch_fractions *to)
{
    imp_quad c[PATCH_NUMBERS_MAX / IMP_QUAD], work[PATCH_NUMBERS_MAX / IMP_QUAD];
    patch shifted = *f;
    patch_localize(f, n, m, lanes, region, c, work);
    patch_forget_motion(&shifted);
    memset(to->off, 0, sizeof to->off);
    for (int axis = 0; axis < 3; ++axis)
        for (int lane = axis; lane < lanes; lane += 4) {
            const double w = c[PATCH_W / IMP_QUAD][PATCH_W % IMP_QUAD];
            to->off[axis][lane / 4] = w > 0 ? c[lane / IMP_QUAD][lane % IMP_QUAD] / w : 0;
            patch_take_off(&shifted, c, lane, to->off[axis][lane / 4]);
        }
    patch_models(&shifted, n, m, lanes, region, c, 4, to->x);
}

/* Makes the fractions of a patch of any degrees; fast for bicubic ones. */
IMP_QUAD_INLINE void patch_fractions_of(const patch *f, const imp_region *region,
                                        patch_fractions *to)
{
    const bool bicubic = f->degree[0] == 3 && f->degree[1] == 3;
    if (bicubic && f->lanes == 8)
        patch_fractions_at(f, 3, 3, 8, region, to);
    else if (bicubic)
        patch_fractions_at(f, 3, 3, 4, region, to);
    else
        patch_fractions_at(f, f->degree[0], f->degree[1], f->lanes, region, to);
}

IMP_QUAD_WIDE static void patch_fractions_wide(const patch *f, const imp_region *region,
                                               patch_fractions *to)
{
    patch_fractions_of(f, region, to);
}

static void patch_rational(const patch *f, const imp_region *region, imp_model model[3])
{
    patch_fractions all;
    if (imp_quad_is_wide())
        patch_fractions_wide(f, region, &all);
    else
        patch_fractions_of(f, region, &all);
    patch_cut(&all.x[PATCH_W], f->weight_lo, f->most[PATCH_W]);
    for (int axis = 0; axis < 3; ++axis)
        model[axis] = patch_quotient(f, axis, region, &all.x[axis], &all.x[PATCH_W], all.off[axis]);
}

imp_status patch_include(const patch *f, const imp_region *region, imp_model model[3])
{
    const imp_status status = patch_region_status(region);
    if (status != IMP_STATUS_OK) {
        for (int i = 0; i < 3; ++i) model[i] = imp_unbounded(7);
        return status;
    }
    if (f->rational)
        patch_rational(f, region, model);
    else if (imp_quad_is_wide())
        patch_polynomial_wide(f, region, model);
    else
        patch_polynomial_of(f, region, model);
    return IMP_STATUS_OK;
}

/* --- A whole patch ---------------------------------------------------------------------------- */

void patch_finish(patch *f, const patch_data *data)
{
    patch_set_differences(f, 0);
    patch_set_differences(f, 1);
    patch_set_series(f, f->given);
    patch_keep(f, data);
}

static void patch_fill(patch *f, const patch_data *data)
{
    patch_set_net(f, data);
    patch_finish(f, data);
}

patch *patch_new(const patch_data *data)
{
    patch *f = patch_allocate(data);
    if (f != NULL) patch_fill(f, data);
    return f;
}

bool patch_renew(patch *f, const patch_data *data)
{
    if (!patch_has_room(f, data)) return false;
    patch_fill(f, data);
    return true;
}
