/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stddef.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

bool instance_offers_symmetry(const imp_surface_type *type)
{
    return type->struct_size >= offsetof(imp_surface_type, symmetry) + sizeof type->symmetry &&
           type->symmetry != NULL;
}

/* --- Asking ---------------------------------------------------------------------------------------- */

/* Squares neither underflow nor overflow; 1e-100 and 1e100 are inside. */
#define AXIS_LEAST 0x1p-340
#define AXIS_MOST 0x1p340

static bool is_sane(const imp_symmetry *found)
{
    double most = 0;
    if (found->kind < IMP_SYMMETRIC_ABOUT_POINT || found->kind > IMP_SYMMETRIC_ACROSS_LINE)
        return false;
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(found->center[i]) || !isfinite(found->axis[i])) return false;
        if (fabs(found->axis[i]) > most) most = fabs(found->axis[i]);
    }
    return found->kind == IMP_SYMMETRIC_ABOUT_POINT || (most > AXIS_LEAST && most < AXIS_MOST);
}

bool surface_has_symmetry(const surface *s)
{
    return instance_offers_symmetry(s->type) && surface_has_distance(s);
}

static imp_status symmetry_of(const surface *s, imp_symmetry *found)
{
    memset(found, 0, sizeof *found);
    if (!surface_has_symmetry(s)) return IMP_UNBOUNDED;
    const surface_call call = surface_call_begin(s->type->name, "symmetry");
    imp_status status = s->type->symmetry(s->self, found);
    status = surface_call_end(call, status);
    if (status != IMP_OK) return status;
    return is_sane(found) ? IMP_OK : SURFACE_BAD_SYMMETRY;
}

/* --- Lengths --------------------------------------------------------------------------------------- */

/* >= |w|. Roundings: squares 1, sums 2, halved by the root, root 1. */
PAD_COVERS(8, 2 + 1);
static double size_upper(const imp_model w[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double x = imp_interval_mag(imp_model_range(&w[i]));
        sum += x * x;
    }
    return padded_upper(sqrt(sum), 8) + ROOT_UNDERFLOW;
}

static double length_lower(const double x[3])
{
    PAD_COVERS(8, 2 + 1);
    return padded_lower(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), 8);
}

/* --- Through one map ------------------------------------------------------------------------------- */

/* A point, and how far at most it is from where it would be if all maps so far had moved it as rotations do
 * and not nearly so. */
typedef struct carried {
    imp_model at[3];
    double off;
} carried;

/* Lemma. Let R be the turn of a map, R^T R = 1 + D with |D| <= d <= 1/2. Its polar decomposition is U H with a
 * rotation U, H = (1 + D)^(1/2) and |H - 1| <= d, since 1 - (1 - d)^(1/2) <= d. So
 *
 *   |R w - U w| = |(H - 1) w| <= d |w|,   |R^T w - U^T w| = |(H - 1) U^T w| <= d |w|,
 *
 * and what the point was off by stays as long under U. */
static void push(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(x->at[i], -pose->pivot[i]);
    for (int i = 0; i < 3; ++i) x->at[i] = imp_add(imp_dot3(pose->turn[i], way), pose->shift[i]);
    x->off = sum_upper(x->off, d * size_upper(way));
}

static void pull(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(x->at[i], pose->shift[i]);
    for (int j = 0; j < 3; ++j) {
        const imp_model column[3] = {pose->turn[0][j], pose->turn[1][j], pose->turn[2][j]};
        x->at[j] = imp_shift(imp_dot3(column, way), pose->pivot[j]);
    }
    x->off = sum_upper(x->off, d * size_upper(way));
}

/* Of R^-1 instead of R^T. Lemma. |R^-1 w| <= |w| / (1 - d)^(1/2) <= 2 |w|, and R^T w - R^-1 w = D R^-1 w is
 * no longer than 2 d |w|, as is R^-1 w - U^T w. */
static void pull_truly(const imp_pose *pose, double d, carried *x)
{
    pull(pose, 2 * d, x);
    for (int j = 0; j < 3; ++j) x->at[j] = imp_add(x->at[j], imp_between(-x->off, x->off));
}

/* --- What is seen at some times -------------------------------------------------------------------- */

/* The center, and where the axis from it ends, if it counts, as they are seen from a before its maps; and points
 * of a. */
typedef struct seen {
    carried feature[2];
    double off; /* points of a are off by so much, seen from b before its maps; length */
    double far; /* and no farther from the center; length */
} seen;

typedef struct question {
    const surface *a, *b;
    size_t a_maps, b_maps; /* of either, without those that both end with */
    imp_symmetry found;    /* of b */
    const imp_model *bare; /* a before its maps */
} question;

/* The pose of one map; *d >= |D|. */
static imp_status pose_of(const surface *s, size_t k, const imp_region *times, imp_pose *pose,
                          double *d)
{
    const imp_status status = surface_pose_of_maps(s, k, k + 1, times, pose);
    if (status == IMP_OK)
        *d = map_turns_exactly(&s->maps[k]) ? 0 : surface_pose_deviation_upper(pose);
    return status == IMP_OK && !(*d <= 0.5) ? IMP_UNBOUNDED : status;
}

/* But for what points are off by. */
static imp_status see_features(const question *q, const imp_region *times, seen *x)
{
    const int features = q->found.kind == IMP_SYMMETRIC_ABOUT_POINT ? 1 : 2;
    imp_model from[3];
    imp_pose pose;
    double d;
    imp_status status = IMP_OK;
    for (int i = 0; i < 3; ++i) {
        x->feature[0].at[i] = imp_num(q->found.center[i]);
        x->feature[1].at[i] = imp_add(imp_num(q->found.center[i]), imp_num(q->found.axis[i]));
    }
    x->feature[0].off = x->feature[1].off = x->off = 0;
    for (size_t k = 0; k < q->b_maps && status == IMP_OK; ++k) {
        status = pose_of(q->b, k, times, &pose, &d);
        for (int f = 0; f < features && status == IMP_OK; ++f) push(&pose, d, &x->feature[f]);
    }
    for (size_t k = q->a_maps; k-- > 0 && status == IMP_OK;) {
        status = pose_of(q->a, k, times, &pose, &d);
        for (int f = 0; f < features && status == IMP_OK; ++f) pull(&pose, d, &x->feature[f]);
    }
    if (status != IMP_OK) return status;
    for (int i = 0; i < 3; ++i)
        from[i] = imp_sub(imp_between(q->bare[i].lo, q->bare[i].hi), x->feature[0].at[i]);
    x->far = sum_upper(size_upper(from), x->feature[0].off);
    return IMP_OK;
}

static imp_status see(const question *q, const imp_region *times, seen *x)
{
    carried y = {.off = 0};
    imp_pose pose;
    double d;
    imp_status status = see_features(q, times, x);
    for (int i = 0; i < 3; ++i) y.at[i] = imp_between(q->bare[i].lo, q->bare[i].hi);
    for (size_t k = 0; k < q->a_maps && status == IMP_OK; ++k) {
        status = pose_of(q->a, k, times, &pose, &d);
        if (status == IMP_OK) push(&pose, d, &y);
    }
    for (size_t k = q->b_maps; k-- > 0 && status == IMP_OK;) {
        status = pose_of(q->b, k, times, &pose, &d);
        if (status == IMP_OK) pull_truly(&pose, d, &y);
    }
    x->off = y.off;
    return status;
}

/* --- How far it slides ----------------------------------------------------------------------------- */

/* Lemma. Let M(t) be what takes points y of a before its maps to b before its maps, if all maps are rotations
 * indeed; c(t) and the unit vector n(t) the center and the axis of b's symmetry as M(t)^-1 shows them to a. Let
 * a rigid motion F take c(t0) and n(t0) to c(t) and n(t), the first up to what the symmetry permits: any shift
 * along n(t), or across. Then S = M(t) F M(t0)^-1 leaves center and axis where they are, but for that shift:
 * it is one of the motions of the symmetry, and M(t) y = S M(t0) F^-1 y. So the claim of b's type of a point
 * z holds for M(t) y, if z is M(t0) F^-1 y, which is as far from M(t0) y as F^-1 y is from y.
 *
 * F turns n(t0) by the smallest angle, which moves what is r away from c(t) by r |n(t) - n(t0)| at most, and
 * shifts by what is left of v = c(t) - c(t0): all of it; of a shift along the line only what is across it, |v x
 * n|; of a shift across only |v . n|; n = n(t0), for n(t) instead |v| |n(t) - n(t0)| more. The shift that F
 * may add is |v| long at most, and adds that to r.
 *
 * In truth points and features are off by what `carried` says, at both times. Rounding of the sum: terms have 4
 * roundings at most, quotient, product, sums; all is positive. */
PAD_COVERS(16, 4 + 6);
static double slip_upper(const imp_symmetry *of, const seen *now, const seen *then)
{
    imp_model v[3], w[3], axis[3];
    for (int i = 0; i < 3; ++i) v[i] = imp_sub(now->feature[0].at[i], then->feature[0].at[i]);
    const double off = now->feature[0].off + then->feature[0].off, all = size_upper(v) + off;
    const double points = now->off + then->off;
    if (of->kind == IMP_SYMMETRIC_ABOUT_POINT) return padded_upper(all + points, 16);
    for (int i = 0; i < 3; ++i) {
        w[i] = imp_sub(imp_sub(now->feature[1].at[i], then->feature[1].at[i]), v[i]);
        axis[i] = imp_sub(then->feature[1].at[i], then->feature[0].at[i]);
    }
    const double length = length_lower(of->axis);
    const double tips = off + now->feature[1].off + then->feature[1].off;
    const double turn = (size_upper(w) + tips) / length;
    double shift = all;
    if (of->kind == IMP_SYMMETRIC_ALONG_LINE) {
        imp_model across[3];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            across[i] = imp_sub(imp_mul(v[j], axis[k]), imp_mul(v[k], axis[j]));
        }
        shift = (size_upper(across) + all * tips) / length + off + all * turn;
    } else if (of->kind == IMP_SYMMETRIC_ACROSS_LINE) {
        const imp_model along[3] = {imp_dot3(v, axis), imp_num(0), imp_num(0)};
        shift = (size_upper(along) + all * tips) / length + off + all * turn;
    }
    return padded_upper(shift + turn * (now->far + all) + points, 16);
}

/* --- Over all times -------------------------------------------------------------------------------- */

/* Where models of a turn hold poorly over a span, halves of it are tried. What comes of rounding alone is
 * good enough; a motion that is surely none within itself is given up at once. */
enum { HALVINGS = 6 };
#define GOOD_ENOUGH 0x1p-40
#define GIVEN_UP 0x1p-16

static imp_region at_times(const imp_region *r, double from, double to)
{
    const double lo[3] = {r->lo[0], r->lo[1], from}, hi[3] = {r->hi[0], r->hi[1], to};
    return region_make(lo, hi);
}

static imp_status slip_over(const question *q, const seen *then, const imp_region *times,
                            int halvings, double *slip)
{
    seen now;
    const imp_status status = see(q, times, &now);
    double found = status == IMP_OK ? slip_upper(&q->found, &now, then) : INFINITY;
    const double middle = times->c[2];
    if (!(found >= 0)) found = INFINITY; /* NaN */
    if (status != IMP_OK && status != IMP_UNBOUNDED) return status;
    const bool divides = halvings > 0 && times->lo[2] < middle && middle < times->hi[2];
    if (found <= GOOD_ENOUGH * then->far || !divides) {
        if (!(found <= *slip)) *slip = found;
        return IMP_OK;
    }
    const imp_region first = at_times(times, times->lo[2], middle);
    const imp_region second = at_times(times, middle, times->hi[2]);
    const imp_status before = slip_over(q, then, &first, halvings - 1, slip);
    return before == IMP_OK ? slip_over(q, then, &second, halvings - 1, slip) : before;
}

/* Whether the motion is surely none within b, as seen at both ends of the times. */
static imp_status give_up(const question *q, const imp_region *still, const imp_region *times,
                          bool *given_up)
{
    seen then;
    imp_status status = see_features(q, still, &then);
    const double ends[2] = {times->lo[2], times->hi[2]};
    for (int k = 0; k < 2 && status == IMP_OK && !*given_up; ++k) {
        const imp_region end = at_times(times, ends[k], ends[k]);
        seen now;
        status = see_features(q, &end, &now);
        *given_up =
            status == IMP_OK && !(slip_upper(&q->found, &now, &then) <= GIVEN_UP * then.far);
    }
    return status;
}

imp_status surface_slip(const surface *a, const surface *b, const imp_model bare[3],
                        const imp_region *times, double moment, double *slip)
{
    const size_t common = surface_common_maps(a, b);
    question q = {a, b, a->map_count - common, b->map_count - common, {0}, bare};
    const imp_region still = at_times(times, moment, moment);
    seen then;
    *slip = INFINITY;
    if ((!surface_is_rigid(a) && a->map_count > 0) || q.a_maps + q.b_maps == 0) return IMP_OK;
    imp_status status = symmetry_of(b, &q.found);
    question center = q;
    center.found.kind = IMP_SYMMETRIC_ABOUT_POINT;
    bool given_up = false;
    /* Rotations about a line keep its center, which alone costs less to see. */
    if (status == IMP_OK && q.found.kind == IMP_SYMMETRIC_ABOUT_LINE)
        status = give_up(&center, &still, times, &given_up);
    if (status == IMP_OK && !given_up) status = give_up(&q, &still, times, &given_up);
    if (given_up) return IMP_OK;
    if (status == IMP_OK) status = see(&q, &still, &then);
    if (status == IMP_OK) {
        *slip = 0;
        status = slip_over(&q, &then, times, HALVINGS, slip);
    }
    if (status != IMP_OK || !(*slip >= 0)) *slip = INFINITY;
    return status == IMP_UNBOUNDED ? IMP_OK : status;
}
