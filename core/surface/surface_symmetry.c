/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stddef.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/carried.h"
#include "core/surface/region.h"

/* --- The callback ----------------------------------------------------------------------------- */

/* Lengths of an axis between these have squares that neither underflow nor overflow. */
#define AXIS_LEAST 0x1p-340
#define AXIS_MOST 0x1p340

static bool is_sane(const imp_symmetry *found)
{
    const uint32_t orbits = IMP_SYMMETRY_ORBIT_U | IMP_SYMMETRY_ORBIT_V,
                   all = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_ALL | orbits;
    double most = 0;
    if (found->kind < IMP_SYMMETRY_ABOUT_POINT || found->kind > IMP_SYMMETRY_ACROSS_LINE)
        return false;
    const bool is_ball = found->kind == IMP_SYMMETRY_ABOUT_POINT;
    for (int i = 0; i < 3; ++i) {
        if (!isfinite(found->center[i]) || !isfinite(found->axis[i])) return false;
        if (fabs(found->axis[i]) > most) most = fabs(found->axis[i]);
    }
    if (found->is_closed > all) return false;
    if (!is_ball && (found->is_closed & IMP_SYMMETRY_ORBIT_ALL) != 0) return false;
    if (is_ball && (found->is_closed & orbits) == 0) return true;
    return most > AXIS_LEAST && most < AXIS_MOST;
}

bool surface_has_symmetry(const surface *s)
{
    return IMP_OFFERS(s->type, symmetry) && surface_has_distance(s);
}

imp_status surface_symmetry(const surface *s, imp_symmetry *found)
{
    memset(found, 0, sizeof *found);
    if (!surface_has_symmetry(s)) return IMP_STATUS_UNBOUNDED;
    const surface_call call = surface_call_begin(s->type->name, "symmetry");
    imp_status status = s->type->symmetry(s->self, found);
    status = surface_call_end(call, status);
    if (status != IMP_STATUS_OK) return status;
    return is_sane(found) ? IMP_STATUS_OK : SURFACE_BAD_SYMMETRY;
}

/* --- Lengths ---------------------------------------------------------------------------------- */

/* Returns an upper bound of |w|. Roundings: squares 1, sums 2, halved by the root, root 1. */
PAD_COVERS(8, 2 + 1);
double surface_size_upper(const imp_model w[3])
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

/* --- Through one map -------------------------------------------------------------------------- */

/* Splits off from `way` the component along the direction f that the pose leaves fixed. Lemma. R f
 * = f, and R^T f = f where R is a rotation; so with w = c f + w', R w = c f + R w', and the
 * remainder of R multiplies w' alone: for a direction along the axis of the turn it is 0 up to
 * rounding, however far the pose turns. Any c is right. If the map is no exact rotation, R^T f
 * differs from f, and nothing is split off. */
static void take_along(const imp_pose *pose, imp_model way[3], imp_model along[3])
{
    imp_model f[3], c = imp_num(0);
    const double *g = pose->fixed, square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    for (int i = 0; i < 3; ++i) f[i] = imp_num(g[i]);
    if (square > AXIS_LEAST * AXIS_LEAST) c = imp_scale(imp_dot3(f, way), 1 / square);
    for (int i = 0; i < 3; ++i) {
        along[i] = imp_mul(c, f[i]);
        way[i] = imp_sub(way[i], along[i]);
    }
}

void carried_turn(const imp_pose *pose, imp_model way[3])
{
    imp_model along[3], turned[3];
    take_along(pose, way, along);
    for (int i = 0; i < 3; ++i) turned[i] = imp_add(imp_dot3(pose->turn[i], way), along[i]);
    memcpy(way, turned, sizeof turned);
}

/* Lemma. Let R be the turn of a map, R^T R = 1 + D with |D| <= d <= 1/2. Its polar decomposition is
 * U H with a rotation U, H = (1 + D)^(1/2) and |H - 1| <= d, since 1 - (1 - d)^(1/2) <= d. So
 *
 *   |R w - U w| = |(H - 1) w| <= d |w|,   |R^T w - U^T w| = |(H - 1) U^T w| <= d |w|,
 *
 * and the length of the point's previous error is unchanged under U. */
void carried_push(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3], along[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(x->at[i], -pose->pivot[i]);
    x->off = sum_upper(x->off, d * surface_size_upper(way));
    take_along(pose, way, along);
    for (int i = 0; i < 3; ++i)
        x->at[i] = imp_add(imp_add(imp_dot3(pose->turn[i], way), along[i]), pose->shift[i]);
}

static void pull(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3], along[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(x->at[i], pose->shift[i]);
    x->off = sum_upper(x->off, d * surface_size_upper(way));
    take_along(pose, way, along);
    for (int j = 0; j < 3; ++j) {
        const imp_model column[3] = {pose->turn[0][j], pose->turn[1][j], pose->turn[2][j]};
        x->at[j] = imp_shift(imp_add(imp_dot3(column, way), along[j]), pose->pivot[j]);
    }
}

/* Pulls back by R^-1 instead of R^T. Lemma. |R^-1 w| <= |w| / (1 - d)^(1/2) <= 2 |w|, and R^T w -
 * R^-1 w = D R^-1 w is no longer than 2 d |w|, as is R^-1 w - U^T w. */
static void pull_truly(const imp_pose *pose, double d, carried *x)
{
    pull(pose, 2 * d, x);
    for (int j = 0; j < 3; ++j) x->at[j] = imp_add(x->at[j], imp_between(-x->off, x->off));
}

/* --- The symmetry in a's coordinates ---------------------------------------------------------- */

/* The symmetry's center, and the end of its axis if the axis matters, in a's coordinates before its
 * maps; and bounds for points of a. */
typedef struct located {
    carried feature[2];
    double off; /* error of a's points in b's coordinates before its maps; length */
    double far; /* >= distance of a's points from the center; length */
} located;

typedef struct slip_input {
    const surface *a, *b;
    size_t a_maps, b_maps;   /* number of maps, without the common last ones */
    size_t a_still, b_still; /* how many first maps are taken at one moment, `then` */
    imp_region then;
    imp_symmetry found;    /* of b */
    const imp_model *bare; /* a before its maps */
} slip_input;

/* Computes the pose of one map, and *d >= |D|. */
imp_status carried_pose(const surface *s, size_t k, const imp_region *times, imp_pose *pose,
                        double *d)
{
    const imp_status status = surface_pose_of_maps(s, k, k + 1, times, pose);
    if (status == IMP_STATUS_OK)
        *d = map_turns_exactly(&s->maps[k]) ? 0 : surface_pose_deviation_upper(pose);
    if (status == IMP_STATUS_OK && *d > 0) memset(pose->fixed, 0, sizeof pose->fixed);
    return status == IMP_STATUS_OK && !(*d <= 0.5) ? IMP_STATUS_UNBOUNDED : status;
}

/* Computes the pose of a's map k, or of b's, at these times. */
static imp_status pose_of_a(const slip_input *q, size_t k, const imp_region *times, imp_pose *pose,
                            double *d)
{
    return carried_pose(q->a, k, k < q->a_still ? &q->then : times, pose, d);
}

static imp_status pose_of_b(const slip_input *q, size_t k, const imp_region *times, imp_pose *pose,
                            double *d)
{
    return carried_pose(q->b, k, k < q->b_still ? &q->then : times, pose, d);
}

/* Computes the symmetry's center and axis at these times, in a's coordinates, without the bounds
 * for points. */
static imp_status locate_features(const slip_input *q, const imp_region *times, located *x)
{
    const int features = q->found.kind == IMP_SYMMETRY_ABOUT_POINT ? 1 : 2;
    imp_model from[3];
    imp_pose pose;
    double d;
    imp_status status = IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) {
        x->feature[0].at[i] = imp_num(q->found.center[i]);
        x->feature[1].at[i] = imp_add(imp_num(q->found.center[i]), imp_num(q->found.axis[i]));
    }
    x->feature[0].off = x->feature[1].off = x->off = 0;
    for (size_t k = 0; k < q->b_maps && status == IMP_STATUS_OK; ++k) {
        status = pose_of_b(q, k, times, &pose, &d);
        for (int f = 0; f < features && status == IMP_STATUS_OK; ++f)
            carried_push(&pose, d, &x->feature[f]);
    }
    for (size_t k = q->a_maps; k-- > 0 && status == IMP_STATUS_OK;) {
        status = pose_of_a(q, k, times, &pose, &d);
        for (int f = 0; f < features && status == IMP_STATUS_OK; ++f)
            pull(&pose, d, &x->feature[f]);
    }
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i)
        from[i] = imp_sub(imp_between(q->bare[i].lo, q->bare[i].hi), x->feature[0].at[i]);
    x->far = sum_upper(surface_size_upper(from), x->feature[0].off);
    return IMP_STATUS_OK;
}

static imp_status locate(const slip_input *q, const imp_region *times, located *x)
{
    carried y = {.off = 0};
    imp_pose pose;
    double d;
    imp_status status = locate_features(q, times, x);
    for (int i = 0; i < 3; ++i) y.at[i] = imp_between(q->bare[i].lo, q->bare[i].hi);
    for (size_t k = 0; k < q->a_maps && status == IMP_STATUS_OK; ++k) {
        status = pose_of_a(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_push(&pose, d, &y);
    }
    for (size_t k = q->b_maps; k-- > 0 && status == IMP_STATUS_OK;) {
        status = pose_of_b(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) pull_truly(&pose, d, &y);
    }
    x->off = y.off;
    return status;
}

/* --- The slip --------------------------------------------------------------------------------- */

/* Lemma. Let M(t) take points y of a before its maps to b before its maps, if all maps are exact
 * rotations; let c(t) and the unit vector n(t) be the images under M(t)^-1 of the center and the
 * axis of b's symmetry. Let a rigid motion F take c(t0) and n(t0) to c(t) and n(t), the first up to
 * what the symmetry permits: any shift along n(t), or across. Then S = M(t) F M(t0)^-1 leaves
 * center and axis fixed, up to that shift: it is one of the motions of the symmetry, and M(t) y = S
 * M(t0) F^-1 y. So the claim of b's type of a point z holds for M(t) y, if z is M(t0) F^-1 y, which
 * is as far from M(t0) y as F^-1 y is from y.
 *
 * F turns n(t0) by the smallest angle, which moves a point at distance r from c(t) by at most r
 * |n(t) - n(t0)|, and shifts by the part of v = c(t) - c(t0) that the symmetry does not permit: all
 * of it; if it permits shifts along the line, |v x n|; if it permits shifts across, |v . n|; here n
 * = n(t0), and for n(t) instead |v| |n(t) - n(t0)| is added. The shift that F may add is at most
 * |v| long, which is added to r.
 *
 * Since maps are not exact, points and features have the errors of `carried`, at both times.
 * Rounding of the sum: terms have at most 4 roundings (quotient, product, sums), and all are
 * positive. */
PAD_COVERS(16, 4 + 6);
static double slip_upper(const imp_symmetry *of, const located *now, const located *then)
{
    imp_model v[3], w[3], axis[3];
    for (int i = 0; i < 3; ++i) v[i] = imp_sub(now->feature[0].at[i], then->feature[0].at[i]);
    const double off = now->feature[0].off + then->feature[0].off,
                 all = surface_size_upper(v) + off;
    const double points = now->off + then->off;
    if (of->kind == IMP_SYMMETRY_ABOUT_POINT) return padded_upper(all + points, 16);
    for (int i = 0; i < 3; ++i) {
        w[i] = imp_sub(imp_sub(now->feature[1].at[i], then->feature[1].at[i]), v[i]);
        axis[i] = imp_sub(then->feature[1].at[i], then->feature[0].at[i]);
    }
    const double length = length_lower(of->axis);
    const double tips = off + now->feature[1].off + then->feature[1].off;
    const double turn = (surface_size_upper(w) + tips) / length;
    double shift = all;
    if (of->kind == IMP_SYMMETRY_ALONG_LINE) {
        imp_model across[3];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            across[i] = imp_sub(imp_mul(v[j], axis[k]), imp_mul(v[k], axis[j]));
        }
        shift = (surface_size_upper(across) + all * tips) / length + off + all * turn;
    } else if (of->kind == IMP_SYMMETRY_ACROSS_LINE) {
        const imp_model along[3] = {imp_dot3(v, axis), imp_num(0), imp_num(0)};
        shift = (surface_size_upper(along) + all * tips) / length + off + all * turn;
    }
    return padded_upper(shift + turn * (now->far + all) + points, 16);
}

/* --- Over all times --------------------------------------------------------------------------- */

/* If models of a turn are loose over a span, its halves are tried, recursively up to this depth. A
 * slip that is mere rounding is not refined; a motion that surely leaves the symmetry ends the
 * search at once. */
enum { HALVINGS = 6 };
#define GOOD_ENOUGH 0x1p-40
#define GIVEN_UP 0x1p-16

static imp_region at_times(const imp_region *r, double from, double to)
{
    const double lo[3] = {r->lo[0], r->lo[1], from}, hi[3] = {r->hi[0], r->hi[1], to};
    return region_make(lo, hi);
}

static imp_status slip_over(const slip_input *q, const located *then, const imp_region *times,
                            int halvings, double *slip)
{
    located now;
    const imp_status status = locate(q, times, &now);
    double found = status == IMP_STATUS_OK ? slip_upper(&q->found, &now, then) : INFINITY;
    const double middle = times->c[2];
    if (!(found >= 0)) found = INFINITY; /* NaN */
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
    const bool divides = halvings > 0 && times->lo[2] < middle && middle < times->hi[2];
    if (found <= GOOD_ENOUGH * then->far || !divides) {
        if (!(found <= *slip)) *slip = found;
        return IMP_STATUS_OK;
    }
    const imp_region first = at_times(times, times->lo[2], middle);
    const imp_region second = at_times(times, middle, times->hi[2]);
    const imp_status before = slip_over(q, then, &first, halvings - 1, slip);
    return before == IMP_STATUS_OK ? slip_over(q, then, &second, halvings - 1, slip) : before;
}

/* Whether the motion surely leaves b's symmetry, by its slip between both ends of the times. */
static imp_status give_up(const slip_input *q, const imp_region *still, const imp_region *times,
                          bool *given_up)
{
    located then;
    imp_status status = locate_features(q, still, &then);
    const double ends[2] = {times->lo[2], times->hi[2]};
    for (int k = 0; k < 2 && status == IMP_STATUS_OK && !*given_up; ++k) {
        const imp_region end = at_times(times, ends[k], ends[k]);
        located now;
        status = locate_features(q, &end, &now);
        *given_up =
            status == IMP_STATUS_OK && !(slip_upper(&q->found, &now, &then) <= GIVEN_UP * then.far);
    }
    return status;
}

/* Computes *slip, given the symmetry; INFINITY if the motion leaves the symmetry. */
static imp_status find_slip(const slip_input *q, const imp_region *times, double *slip)
{
    slip_input center = *q;
    bool given_up = false;
    located then;
    imp_status status = IMP_STATUS_OK;
    *slip = INFINITY;
    center.found.kind = IMP_SYMMETRY_ABOUT_POINT;
    /* Rotations about a line keep its center, which is cheaper to compute alone. */
    if (q->found.kind == IMP_SYMMETRY_ABOUT_LINE)
        status = give_up(&center, &q->then, times, &given_up);
    if (status == IMP_STATUS_OK && !given_up) status = give_up(q, &q->then, times, &given_up);
    if (given_up) return IMP_STATUS_OK;
    if (status == IMP_STATUS_OK) status = locate(q, &q->then, &then);
    if (status == IMP_STATUS_OK) {
        *slip = 0;
        status = slip_over(q, &then, times, HALVINGS, slip);
    }
    if (status != IMP_STATUS_OK || !(*slip >= 0)) *slip = INFINITY;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

static bool moves_rigidly(const surface *s) { return s->map_count == 0 || surface_is_rigid(s); }

/* Estimates how a point carried by b's maps moves from one time to another, in a's coordinates. */
static imp_status way_of(const slip_input *q, const double point[3], const imp_region *other,
                         double way[3])
{
    slip_input p = *q;
    located now, then;
    p.found.kind = IMP_SYMMETRY_ABOUT_POINT;
    memcpy(p.found.center, point, sizeof p.found.center);
    imp_status status = locate_features(&p, &q->then, &then);
    if (status == IMP_STATUS_OK) status = locate_features(&p, other, &now);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        way[i] = now.feature[0].at[i].a - then.feature[0].at[i].a;
    return status;
}

/* Finds two directions across the axis of the plane. */
static void directions_across(const double axis[3], double across[2][3])
{
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(axis[i]) < fabs(axis[least])) least = i;
    double side[3] = {0, 0, 0};
    side[least] = 1;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[0][i] = axis[j] * side[k] - axis[k] * side[j];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[1][i] = axis[j] * across[0][k] - axis[k] * across[0][j];
    }
}

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

#define SINGULAR 0x1p-30

/* Chooses the plane's center, which may be any of its points: the one that moves least, since a
 * fixed point has the tightest bound. The motion depends linearly on the point. */
static imp_status choose_center(slip_input *q, const imp_region *times)
{
    const double t = times->lo[2] + 0.375 * (times->hi[2] - times->lo[2]);
    const imp_region other = at_times(times, t, t);
    double across[2][3], way[3][3], *center = q->found.center;
    directions_across(q->found.axis, across);
    imp_status status = way_of(q, center, &other, way[0]);
    for (int k = 0; k < 2 && status == IMP_STATUS_OK; ++k) {
        double point[3];
        for (int i = 0; i < 3; ++i) point[i] = center[i] + across[k][i];
        status = way_of(q, point, &other, way[k + 1]);
        for (int i = 0; i < 3; ++i) way[k + 1][i] -= way[0][i];
    }
    if (status != IMP_STATUS_OK) return status;
    const double a = dot(way[1], way[1]), b = dot(way[1], way[2]), c = dot(way[2], way[2]);
    const double det = a * c - b * b, r = -dot(way[1], way[0]), s = -dot(way[2], way[0]);
    if (!(det > SINGULAR * a * c)) return IMP_STATUS_OK;
    const double along[2] = {(c * r - b * s) / det, (a * s - b * r) / det};
    for (int i = 0; i < 3; ++i) center[i] += along[0] * across[0][i] + along[1] * across[1][i];
    return IMP_STATUS_OK;
}

imp_status surface_slip(const surface *a, const surface *b, const imp_model bare[3],
                        const imp_region *times, double moment, double *slip)
{
    const size_t common = surface_common_maps(a, b);
    slip_input q = {.a = a,
                    .b = b,
                    .a_maps = a->map_count - common,
                    .b_maps = b->map_count - common,
                    .then = at_times(times, moment, moment),
                    .bare = bare};
    *slip = INFINITY;
    if (!moves_rigidly(a) || q.a_maps + q.b_maps == 0) return IMP_STATUS_OK;
    imp_status status = surface_symmetry(b, &q.found);
    if (status == IMP_STATUS_OK && q.found.kind == IMP_SYMMETRY_ACROSS_LINE)
        status = choose_center(&q, times);
    if (status == IMP_STATUS_OK && is_sane(&q.found)) return find_slip(&q, times, slip);
    return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_slip_along(const surface *a, const surface *b, const surface_plane *plane,
                              const imp_model bare[3], const imp_region *times, double moment,
                              double *slip)
{
    slip_input q = {.a = a,
                    .b = b,
                    .a_maps = a->map_count,
                    .b_maps = b->map_count,
                    .then = at_times(times, moment, moment),
                    .found = {.kind = IMP_SYMMETRY_ACROSS_LINE},
                    .bare = bare};
    memcpy(q.found.center, plane->center, sizeof q.found.center);
    memcpy(q.found.axis, plane->axis, sizeof q.found.axis);
    *slip = INFINITY;
    if (!moves_rigidly(a) || !moves_rigidly(b)) return IMP_STATUS_OK;
    const imp_status status = choose_center(&q, times);
    if (status == IMP_STATUS_OK && is_sane(&q.found)) return find_slip(&q, times, slip);
    return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* --- Pairs that turn within themselves -------------------------------------------------------- */

/* Returns the rotations that keep the whole surface. IMP_STATUS_UNBOUNDED: none are known, for
 * instance if it has several pieces, each with its own symmetry. */
static imp_status closed_symmetry_of(const surface *s, imp_symmetry *found)
{
    if (!IMP_OFFERS(s->type, symmetry) || s->piece_count > 1) return IMP_STATUS_UNBOUNDED;
    const imp_status status = surface_symmetry(s, found);
    if (status != IMP_STATUS_OK) return status;
    if ((found->is_closed & IMP_SYMMETRY_CLOSED) == 0) return IMP_STATUS_UNBOUNDED;
    if (found->kind != IMP_SYMMETRY_ABOUT_POINT) found->kind = IMP_SYMMETRY_ABOUT_LINE;
    return IMP_STATUS_OK;
}

/* Lemma. Let P(t) be the motion by the first maps of s. In the lemma of slip_upper let b be s under
 * these maps, and a be P(t0) s at rest. Then the points of P(t0) s are within `slip` of P(t) s, and
 * those of P(t) s within `slip` of P(t0) s: F, which takes one center and axis to the other, moves
 * neither farther. So P(t) s may be replaced by P(t0) s if `slip` is subtracted from the distances
 * that are proved. */
static imp_status slip_of_first(const surface *s, size_t maps, const imp_symmetry *found,
                                const imp_model bare[3], const imp_region *times,
                                const imp_region *then, double *slip)
{
    imp_model there[3];
    surface rest = {.map_count = 0};
    memcpy(there, bare, sizeof there);
    for (size_t k = 0; k < maps; ++k) {
        imp_pose pose;
        double d;
        carried y = {.off = 0};
        const imp_status status = carried_pose(s, k, then, &pose, &d);
        if (status != IMP_STATUS_OK) return status;
        memcpy(y.at, there, sizeof y.at);
        carried_push(&pose, d, &y);
        for (int i = 0; i < 3; ++i) {
            const imp_interval range = imp_model_range(&y.at[i]);
            there[i] = imp_between(difference_lower(range.lo, y.off), sum_upper(range.hi, y.off));
        }
    }
    const slip_input q = {
        .a = &rest, .b = s, .b_maps = maps, .then = *then, .found = *found, .bare = there};
    return find_slip(&q, times, slip);
}

/* Counts how many of the first maps together only turn s within itself, and bounds their slip. */
static imp_status first_maps_within(const surface *s, const imp_model bare[3],
                                    const imp_region *times, const imp_region *then, size_t *maps,
                                    double *slip)
{
    imp_symmetry found;
    imp_status status = closed_symmetry_of(s, &found);
    *maps = 0;
    *slip = 0;
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    for (size_t k = s->map_count; k > 0; --k) {
        double found_slip;
        status = slip_of_first(s, k, &found, bare, times, then, &found_slip);
        if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
        if (status != IMP_STATUS_OK || !(found_slip < INFINITY)) continue;
        *maps = k;
        *slip = found_slip;
        return IMP_STATUS_OK;
    }
    return IMP_STATUS_OK;
}

/* Bounds in *slip how far a's motion, as seen from b, leaves b's closed symmetry. */
static imp_status slip_of_rest(const surface *const s[2], const size_t still[2],
                               const imp_model *bare, const imp_region *times,
                               const imp_region *then, double *slip)
{
    slip_input q = {.a = s[0],
                    .b = s[1],
                    .a_maps = s[0]->map_count,
                    .b_maps = s[1]->map_count,
                    .a_still = still[0],
                    .b_still = still[1],
                    .then = *then,
                    .bare = bare};
    *slip = INFINITY;
    imp_status status = closed_symmetry_of(s[1], &q.found);
    if (status == IMP_STATUS_OK) status = find_slip(&q, times, slip);
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* >= how far points of s are at these times from where they would be, if each of its maps turned
 * them as the rotation next to its turn does (carried_push). */
static imp_status off_of(const surface *s, const imp_model bare[3], const imp_region *times,
                         double *off)
{
    carried y = {.off = 0};
    imp_status status = IMP_STATUS_OK;
    bool is_exact = true;
    for (size_t k = 0; k < s->map_count; ++k) is_exact = is_exact && map_turns_exactly(&s->maps[k]);
    for (int i = 0; i < 3; ++i) y.at[i] = imp_between(bare[i].lo, bare[i].hi);
    for (size_t k = 0; k < s->map_count && !is_exact && status == IMP_STATUS_OK; ++k) {
        imp_pose pose;
        double d;
        status = carried_pose(s, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_push(&pose, d, &y);
    }
    *off = y.off;
    return status;
}

/* Adds to *slip how much maps that are only nearly rotations may change the distance. Lemma.
 * slip_of_first and slip_of_rest bound motions in which rotations, which preserve distances,
 * replace the maps' turns. Under the maps themselves points of either surface are off by at most
 * its `off`, at any of the times and at the moment: so each of the two distances is off by at most
 * the sum of both surfaces' `off`. */
static imp_status add_off(const surface *const s[2], const imp_model bare[2][3],
                          const imp_region *times, double *slip)
{
    imp_status status = IMP_STATUS_OK;
    for (int k = 0; k < 2 && status == IMP_STATUS_OK; ++k) {
        double off;
        status = off_of(s[k], bare[k], times, &off);
        if (status == IMP_STATUS_OK && off > 0) *slip = sum_upper(*slip, 2 * off);
    }
    if (status != IMP_STATUS_OK || !(*slip >= 0)) *slip = INFINITY;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* A point that rotations of the surface's closed symmetry leave where it is; any point if it has
 * none. */
static void middle_of(const surface *s, const imp_model bare[3], double x[3])
{
    imp_symmetry found;
    const bool is_closed = closed_symmetry_of(s, &found) == IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) x[i] = is_closed ? found.center[i] : bare[i].a;
}

enum { LOOKS = 3 };
#define SURELY_APART 0x1p-12

/* Whether a look at some moments shows that the pair does not only turn within itself: as long as
 * it does, these two points are always as far apart. Errors of it cost time, or pairs. */
static bool surely_moves(const surface *const s[2], const imp_model bare[2][3],
                         const imp_region *times)
{
    static const double looks[LOOKS] = {0, 0.37, 1};
    double middle[2][3], least = INFINITY, most = 0;
    for (int k = 0; k < 2; ++k) middle_of(s[k], bare[k], middle[k]);
    for (int look = 0; look < LOOKS; ++look) {
        const double t = times->lo[2] + looks[look] * (times->hi[2] - times->lo[2]);
        double x[2][3], way[3];
        memcpy(x, middle, sizeof x);
        for (int k = 0; k < 2; ++k)
            if (surface_move_outward(s[k], 0, t, x[k]) != IMP_STATUS_OK) return false;
        for (int i = 0; i < 3; ++i) way[i] = x[1][i] - x[0][i];
        const double apart = sqrt(dot(way, way));
        if (!(apart >= least)) least = apart;
        if (!(apart <= most)) most = apart;
    }
    return most - least > SURELY_APART * most;
}

imp_status surface_pair_slip(const surface *const s[2], const imp_model bare[2][3],
                             const imp_region *times, double moment, double *slip, int *asked)
{
    const imp_region then = at_times(times, moment, moment);
    size_t still[2];
    double own[2], rest = 0;
    *slip = INFINITY;
    if (!moves_rigidly(s[0]) || !moves_rigidly(s[1])) return IMP_STATUS_OK;
    if (surely_moves(s, bare, times)) return IMP_STATUS_OK;
    for (int k = 0; k < 2; ++k) {
        *asked = k;
        const imp_status status =
            first_maps_within(s[k], bare[k], times, &then, &still[k], &own[k]);
        if (status != IMP_STATUS_OK) return status;
    }
    if (still[0] < s[0]->map_count || still[1] < s[1]->map_count) {
        imp_status status = slip_of_rest(s, still, bare[0], times, &then, &rest);
        if (status == IMP_STATUS_OK && !(rest < INFINITY)) {
            const surface *const turned[2] = {s[1], s[0]};
            *asked = 0;
            status =
                slip_of_rest(turned, (size_t[2]){still[1], still[0]}, bare[1], times, &then, &rest);
        }
        if (status != IMP_STATUS_OK) return status;
    }
    *slip = sum_upper(sum_upper(own[0], own[1]), rest);
    return *slip < INFINITY ? add_off(s, bare, times, slip) : IMP_STATUS_OK;
}
