/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/surface/slip.h"

/* --- Center and axis in the coordinates of a -------------------------------------------------- */

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

static bool is_across(const slip_input *q) { return q->found.kind == IMP_SYMMETRY_ACROSS_LINE; }

static bool has_axis(const slip_input *q) { return q->found.kind != IMP_SYMMETRY_ABOUT_POINT; }

/* Carries the symmetry by b's map k. Across a line, any point of the plane is as good: only the
 * plane matters. */
static void push_place(const slip_input *q, const imp_pose *pose, double d, slip_place *x)
{
    if (!is_across(q)) carried_push(pose, d, &x->center);
    if (has_axis(q)) carried_push_plane(pose, d, &x->plane);
}

static void pull_place(const slip_input *q, const imp_pose *pose, double d, slip_place *x)
{
    if (!is_across(q)) carried_pull(pose, d, &x->center);
    if (has_axis(q)) carried_pull_plane(pose, d, &x->plane);
}

static void start_place(const slip_input *q, slip_place *x)
{
    imp_model axis[3], center[3];
    for (int i = 0; i < 3; ++i) {
        center[i] = imp_num(q->found.center[i]);
        axis[i] = imp_num(q->found.axis[i]);
    }
    *x = (slip_place){.plane = {.height = imp_dot3(axis, center)}};
    memcpy(x->center.at, center, sizeof center);
    memcpy(x->plane.normal.at, axis, sizeof axis);
}

/* Replaces the plane's height by that above the middle of a's points, which is next to them, and
 * bounds how far they are from there, or from the center. */
static void view_from_a(const slip_input *q, slip_place *x)
{
    imp_model from[3], middle[3];
    for (int i = 0; i < 3; ++i) {
        middle[i] = imp_num(0.5 * q->bare[i].lo + 0.5 * q->bare[i].hi);
        from[i] = imp_sub(imp_between(q->bare[i].lo, q->bare[i].hi),
                          is_across(q) ? middle[i] : x->center.at[i]);
    }
    x->far = sum_upper(surface_size_upper(from), x->center.off);
    if (!is_across(q)) return;
    x->plane.height = imp_sub(x->plane.height, imp_dot3(x->plane.normal.at, middle));
    const double tilt = x->plane.normal.off;
    if (tilt > 0) x->plane.off = sum_upper(x->plane.off, tilt * surface_size_upper(middle));
}

static imp_status locate_symmetry(const slip_input *q, const imp_region *times, slip_place *x)
{
    imp_pose pose;
    double d;
    imp_status status = IMP_STATUS_OK;
    start_place(q, x);
    for (size_t k = 0; k < q->b_maps && status == IMP_STATUS_OK; ++k) {
        status = pose_of_b(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) push_place(q, &pose, d, x);
    }
    for (size_t k = q->a_maps; k-- > 0 && status == IMP_STATUS_OK;) {
        status = pose_of_a(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) pull_place(q, &pose, d, x);
    }
    if (status == IMP_STATUS_OK) view_from_a(q, x);
    return status;
}

static bool turn_exactly(const surface *s, size_t maps)
{
    bool all = true;
    for (size_t k = 0; k < maps; ++k) all = all && map_turns_exactly(&s->maps[k]);
    return all;
}

/* Adds the error of a's points, which exact rotations have not. */
static imp_status locate(const slip_input *q, const imp_region *times, slip_place *x)
{
    carried y = {.off = 0};
    imp_pose pose;
    double d;
    imp_status status = locate_symmetry(q, times, x);
    if (turn_exactly(q->a, q->a_maps) && turn_exactly(q->b, q->b_maps)) return status;
    for (int i = 0; i < 3; ++i) y.at[i] = imp_between(q->bare[i].lo, q->bare[i].hi);
    for (size_t k = 0; k < q->a_maps && status == IMP_STATUS_OK; ++k) {
        status = pose_of_a(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_push(&pose, d, &y);
    }
    for (size_t k = q->b_maps; k-- > 0 && status == IMP_STATUS_OK;) {
        status = pose_of_b(q, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_pull_truly(&pose, d, &y);
    }
    x->off = y.off;
    return status;
}

/* --- The slip --------------------------------------------------------------------------------- */

static double length_lower(const double x[3])
{
    PAD_COVERS(8, 2 + 1);
    return padded_lower(sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), 8);
}

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
 * of it; if it permits shifts along the line, |v x n|; here n = n(t0), and for n(t) instead |v|
 * |n(t) - n(t0)| is added. The shift that F may add is at most |v| long, which is added to r.
 *
 * If the symmetry permits shifts across the line, F need only take the plane n(t0).x = h(t0) to
 * n(t).x = h(t). It turns about the middle m of a's points, which takes the plane to n(t).x = h(t0)
 * - n(t0).m + n(t).m, and shifts along n(t) by what the height above m has changed, which is added
 * to r.
 *
 * Since maps are not exact, points, axes and heights have the errors of `carried`, at both times.
 * Rounding of the sum: terms have at most 4 roundings (quotient, product, sums), and all are
 * positive. */
PAD_COVERS(16, 4 + 6);
static double slip_upper(const imp_symmetry *of, const slip_place *now, const slip_place *then)
{
    imp_model v[3], w[3];
    const imp_model *n = then->plane.normal.at;
    for (int i = 0; i < 3; ++i) v[i] = imp_sub(now->center.at[i], then->center.at[i]);
    const double off = now->center.off + then->center.off, all = surface_size_upper(v) + off;
    const double points = now->off + then->off;
    if (of->kind == IMP_SYMMETRY_ABOUT_POINT) return padded_upper(all + points, 16);
    for (int i = 0; i < 3; ++i) w[i] = imp_sub(now->plane.normal.at[i], n[i]);
    const double length = length_lower(of->axis);
    const double tips = now->plane.normal.off + then->plane.normal.off;
    const double turn = (surface_size_upper(w) + tips) / length;
    double shift = all, added = all;
    if (of->kind == IMP_SYMMETRY_ALONG_LINE) {
        imp_model across[3];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            across[i] = imp_sub(imp_mul(v[j], n[k]), imp_mul(v[k], n[j]));
        }
        shift = (surface_size_upper(across) + all * tips) / length + off + all * turn;
    } else if (of->kind == IMP_SYMMETRY_ACROSS_LINE) {
        const imp_model rise = imp_sub(now->plane.height, then->plane.height);
        const double most = imp_interval_mag(imp_model_range(&rise));
        shift = added = (most + now->plane.off + then->plane.off) / length;
    }
    return padded_upper(shift + turn * (now->far + added) + points, 16);
}

/* Lemma. In that of slip_upper, the turn about m that takes n(t0) to n(t) moves points of a by at
 * most |n(t) - n(t0)| times their distance from m. Maps that are exact leave no errors `off`. */
imp_status slip_follow_plane(const slip_input *q, const imp_region *times, imp_model *rise,
                             double *tilt)
{
    slip_place now, then;
    imp_model w[3];
    *tilt = INFINITY;
    imp_status status = locate_symmetry(q, &q->then, &then);
    if (status == IMP_STATUS_OK) status = locate_symmetry(q, times, &now);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) w[i] = imp_sub(now.plane.normal.at[i], then.plane.normal.at[i]);
    *rise = imp_sub(now.plane.height, then.plane.height);
    const double most = surface_size_upper(w) / length_lower(q->found.axis) * now.far;
    if (most >= 0) *tilt = padded_upper(most, 16);
    return IMP_STATUS_OK;
}

/* --- Over all times --------------------------------------------------------------------------- */

/* If models of a turn are loose over a span, its halves are tried, recursively up to this depth. A
 * slip that is mere rounding is not refined; a motion that surely leaves the symmetry ends the
 * search at once. */
enum { HALVINGS = 6 };
#define GOOD_ENOUGH 0x1p-40
#define GIVEN_UP 0x1p-16

static imp_status slip_over(const slip_input *q, const slip_place *then, const imp_region *times,
                            int halvings, double *slip)
{
    slip_place now;
    const imp_status status = locate(q, times, &now);
    double found = status == IMP_STATUS_OK ? slip_upper(&q->found, &now, then) : INFINITY;
    const double middle = times->c[2];
    if (!(found >= 0)) found = INFINITY; /* NaN */
    if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
    const bool divides = halvings > 0 && times->lo[2] < middle && middle < times->hi[2];
    if (found <= q->enough || found <= GOOD_ENOUGH * then->far || !divides) {
        if (q->enough > 0 && found > q->enough) found = INFINITY;
        if (!(found <= *slip)) *slip = found;
        return IMP_STATUS_OK;
    }
    const imp_region first = slip_at_times(times, times->lo[2], middle);
    const imp_region second = slip_at_times(times, middle, times->hi[2]);
    const imp_status before = slip_over(q, then, &first, halvings - 1, slip);
    if (before != IMP_STATUS_OK || *slip == INFINITY) return before;
    return slip_over(q, then, &second, halvings - 1, slip);
}

/* Whether the motion surely leaves b's symmetry, by its slip between both ends of the times. */
static imp_status give_up(const slip_input *q, const imp_region *still, const imp_region *times,
                          bool *given_up)
{
    slip_place then;
    imp_status status = locate_symmetry(q, still, &then);
    const double ends[2] = {times->lo[2], times->hi[2]};
    for (int k = 0; k < 2 && status == IMP_STATUS_OK && !*given_up; ++k) {
        const imp_region end = slip_at_times(times, ends[k], ends[k]);
        slip_place now;
        status = locate_symmetry(q, &end, &now);
        *given_up =
            status == IMP_STATUS_OK && !(slip_upper(&q->found, &now, &then) <= GIVEN_UP * then.far);
    }
    return status;
}

imp_status slip_find(const slip_input *q, const imp_region *times, double *slip)
{
    slip_input center = *q;
    bool given_up = false;
    slip_place then;
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

bool surface_may_slip(const surface *a) { return slip_moves_rigidly(a); }

imp_status surface_slip(const surface *a, const surface *b, const imp_model bare[3],
                        const imp_region *times, double moment, double enough, double *slip)
{
    const size_t common = surface_common_maps(a, b);
    slip_input q = {.a = a,
                    .b = b,
                    .a_maps = a->map_count - common,
                    .b_maps = b->map_count - common,
                    .then = slip_at_times(times, moment, moment),
                    .bare = bare};
    *slip = INFINITY;
    if (!slip_moves_rigidly(a) || q.a_maps + q.b_maps == 0) return IMP_STATUS_OK;
    imp_status status = surface_symmetry(b, &q.found);
    if (status == IMP_STATUS_OK && symmetry_is_screw(&q.found))
        return enough > 0 ? slip_find_screw(&q, times, enough, slip) : IMP_STATUS_OK;
    if (status == IMP_STATUS_OK && symmetry_is_sane(&q.found)) return slip_find(&q, times, slip);
    return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_slip_along(const surface *a, const surface *b, const surface_plane *plane,
                              const imp_model bare[3], const imp_region *times, double moment,
                              double enough, double *slip)
{
    slip_input q = {.a = a,
                    .b = b,
                    .a_maps = a->map_count,
                    .b_maps = b->map_count,
                    .then = slip_at_times(times, moment, moment),
                    .found = {.kind = IMP_SYMMETRY_ACROSS_LINE},
                    .bare = bare,
                    .enough = enough};
    memcpy(q.found.center, plane->center, sizeof q.found.center);
    memcpy(q.found.axis, plane->axis, sizeof q.found.axis);
    *slip = INFINITY;
    if (!slip_moves_rigidly(a) || !slip_moves_rigidly(b)) return IMP_STATUS_OK;
    return symmetry_is_sane(&q.found) ? slip_find(&q, times, slip) : IMP_STATUS_OK;
}
