/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/piece_shadow.h"

#include <impinge/model.h>

#include "core/base/rounding.h"

/* A right-handed frame whose third vector is the line. */
typedef struct line_frame {
    vec3 center, side, axis;
} line_frame;

/* Where the points of a piece are: along the line, and beside it. */
typedef struct ring {
    double along[2], beside[2];
} ring;

/* The part of x that is across the axis, a unit vector up to rounding. What one subtraction leaves
 * along the axis is rounding of |x|, the second one's that of the part itself. */
static vec3 part_across(vec3 axis, vec3 x)
{
    vec3 across = x;
    for (int k = 0; k < 2; ++k) across = vec3_sub(across, vec3_scale(axis, vec3_dot(across, axis)));
    return across;
}

/* Lemma. With z = sum of weights w_k >= 0 of corners z_k, k.(z - c) is between the least and the
 * greatest of the corners', and the distance q(z) from the line is at most the greatest, being
 * convex; for each e across the line, |e| = 1 but for rounding, q(z) >= e.(z - c) >= the least of
 * the corners'. One e is the piece's normal, for which that is sharp where the piece is flat along
 * the line; the other points to its middle. Rounding: as of planes (piece_planes.c), 16 of e and 8
 * of the products, in units of u |z - c|. Of e (part_across): one subtraction leaves at most 16 u
 * |x| along k, which is 2^-29 of a part longer than 2^-20 |x|; the second one leaves 8 u of the
 * part; its length has 3 roundings. */
enum { RING_ROUNDING = 64 };
_Static_assert(1 + 8 + 4 + 8 + 16 + 8 <= RING_ROUNDING, "rounding of a ring");

static ring ring_of_flat(const line_frame *f, const vec3 z[4])
{
    const vec3 normal = vec3_cross(vec3_sub(z[3], z[0]), vec3_sub(z[2], z[1]));
    vec3 from[4], middle = {{0, 0, 0}};
    ring r = {{INFINITY, -INFINITY}, {0, 0}};
    for (int k = 0; k < 4; ++k) {
        from[k] = vec3_sub(z[k], f->center);
        middle = vec3_add(middle, from[k]);
        const double along = vec3_dot(from[k], f->axis);
        const double beside = vec3_norm(vec3_cross(from[k], f->axis));
        if (along < r.along[0]) r.along[0] = along;
        if (along > r.along[1]) r.along[1] = along;
        if (beside > r.beside[1]) r.beside[1] = beside;
    }
    const vec3 ways[3] = {normal, vec3_scale(normal, -1), middle};
    for (int j = 0; j < 3; ++j) {
        const vec3 across = part_across(f->axis, ways[j]);
        const double size = vec3_norm(across);
        double least = INFINITY;
        if (!(size > 0x1p-20 * vec3_norm(ways[j]))) continue;
        for (int k = 0; k < 4; ++k) {
            const double here = vec3_dot(across, from[k]) / size;
            if (here < least) least = here;
        }
        if (least > r.beside[0]) r.beside[0] = least;
    }
    return r;
}

/* Lemma. A hoop's point z is sum w_k (z_k + r_k e_k), e_k across the hoop's axis. k.e_k is at most
 * the sine s between the axes, so that the place of each term along the line is that of z_k but for
 * r_k s; and the term is no farther beside the line than q(z_k) + r_k, hence z, q being convex.
 * Rounding: a place as of rings, 21; radius 1, sine 16, product and sums 3. */
_Static_assert(21 + 1 + 16 + 3 <= RING_ROUNDING, "rounding of a hoop");
static ring ring_of(const line_frame *f, const piece_cell *z)
{
    ring r = {{INFINITY, -INFINITY}, {0, 0}};
    if (!z->is_hoop) return ring_of_flat(f, z->corner);
    const double sine = vec3_norm(vec3_cross(z->axis, f->axis));
    for (int k = 0; k < 4; ++k) {
        const vec3 from = vec3_sub(z->corner[k], f->center);
        const double along = vec3_dot(from, f->axis);
        const double beside = vec3_norm(vec3_cross(from, f->axis)), radius = z->radius[k];
        if (along - radius * sine < r.along[0]) r.along[0] = along - radius * sine;
        if (along + radius * sine > r.along[1]) r.along[1] = along + radius * sine;
        if (beside + radius > r.beside[1]) r.beside[1] = beside + radius;
    }
    return r;
}

/* How far the course's line is from the frame's, for points within `reach` of its center, twice. */
PAD_COVERS(32, 16);
static double lines_apart(const surface_course *c, const line_frame *f, double reach)
{
    if (!c->spins) return 0;
    vec3 axis = vec3_from(c->axis);
    if (vec3_dot(axis, f->axis) < 0) axis = vec3_scale(axis, -1);
    const vec3 way = vec3_sub(vec3_from(c->center), f->center);
    const double angle = vec3_norm(vec3_sub(axis, f->axis)) + 32 * UNIT_ROUNDOFF;
    const double off = vec3_norm(vec3_cross(way, axis)) + 32 * UNIT_ROUNDOFF * vec3_norm(way);
    return padded_upper(2 * ((reach + off + vec3_norm(way)) * angle + off), 32);
}

/* Lemma. Let a's symmetry have every rotation about the frame's line, along k, and z be a point of
 * the piece with the places (p, q). S(t) is a rotation about the course's line; that about the
 * frame's by the same angle takes z to a point no farther from S z than 2 s, where a rigid motion
 * that takes the one line to the other moves no point in question farther than s (surface_orbit.c):
 * it turns about the frame's center by the angle between the lines and shifts by their distance. A
 * rotation of the symmetry then takes that to c + p k + q e, e any unit vector across, and leaves
 * vectors along k as they are. So what a's type claims of all points within `off` of
 * c + (p + k.way) k + q e, p and q anywhere in the ring, holds for b's point; `off` has 2 s, the
 * part of `way` that is across, the course's with how far it wanders, and the slack of b's pieces.
 * The models' u and v stand for p and q. */
static void points_of(const line_frame *f, const imp_region *over, const ring *r, imp_model along,
                      double off, imp_model point[3])
{
    const double lo[2] = {r->along[0], r->beside[0]}, hi[2] = {r->along[1], r->beside[1]};
    imp_model place[2];
    for (int j = 0; j < 2; ++j)
        place[j] = imp_shift(imp_scale(imp_param(over, j), 0.5 * hi[j] - 0.5 * lo[j]),
                             0.5 * lo[j] + 0.5 * hi[j]);
    place[0] = imp_add(place[0], along);
    for (int i = 0; i < 3; ++i) {
        const imp_model at =
            imp_add(imp_scale(place[0], f->axis.x[i]), imp_scale(place[1], f->side.x[i]));
        point[i] = imp_add(imp_shift(at, f->center.x[i]), imp_between(-off, off));
    }
}

/* The motion of b beside S(t): numbers, models along the line, and a bound of what is across. */
typedef struct drift {
    vec3 at;
    imp_model along;
    double across;
} drift;

static drift drift_of(const surface_course *c, const line_frame *f)
{
    drift d = {.across = 0};
    imp_model rest[3], axis[3];
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        d.at.x[i] = c->spins ? 0 : c->way[i].a;
        rest[i] = imp_shift(c->way[i], -d.at.x[i]);
        axis[i] = imp_num(f->axis.x[i]);
    }
    d.along = imp_dot3(axis, rest);
    for (int i = 0; i < 3; ++i) {
        const imp_model across = imp_sub(rest[i], imp_scale(d.along, f->axis.x[i]));
        const double most = imp_interval_mag(imp_model_range(&across));
        sum += most * most;
    }
    d.across = padded_upper(sqrt(sum), 16) + ROOT_UNDERFLOW;
    return d;
}

/* A cell as a sees it at the middle of the times. Its slack then has what a hoop loses by the turn
 * (piece_shadow_seen). */
static piece_cell place_of(const piece_course *of, const drift *d, const piece_cell *y)
{
    piece_cell z = piece_shadow_seen(of, y);
    for (int j = 0; j < 4; ++j) z.corner[j] = vec3_add(z.corner[j], d->at);
    return z;
}

static bool find_frame(const piece_course *of, const surface *own, line_frame *f,
                       imp_status *status)
{
    bool has;
    *status = surface_line_of(own, &of->course, f->center.x, f->axis.x, &has);
    if (*status != IMP_STATUS_OK || !has) return false;
    f->side = vec3_across(f->axis);
    return true;
}

/* Roundings of `off`: sums 7. */
PAD_COVERS(16, 7);
imp_code piece_rings_cut(const piece_course *of, const surface *own, double gamma_clear,
                         const time_window *window, piece_view *view, imp_error *error)
{
    const imp_region over =
        region_make((double[3]){-1, -1, of->times.lo[2]}, (double[3]){1, 1, of->times.hi[2]});
    const surface_course *c = &of->course;
    line_frame f;
    imp_status status;
    piece_view all = {.is_apart = true, .left = *window, .lower = INFINITY};
    *view = (piece_view){.left = *window};
    if (!find_frame(of, own, &f, &status))
        return status == IMP_STATUS_OK ? IMP_SUCCESS : distance_fault(own, status, error);
    const drift d = drift_of(c, &f);
    const double size =
        of->other->reach + vec3_norm(vec3_from(c->shift)) + vec3_norm(d.at) + vec3_norm(f.center);
    const double off = padded_upper(lines_apart(c, &f, size) + d.across + c->off + c->wander +
                                        of->other->slack + RING_ROUNDING * UNIT_ROUNDOFF * size,
                                    16);
    for (size_t k = 0; k < of->other->count && !piece_view_is_useless(&all, window); ++k) {
        imp_model point[3], g;
        piece_view one = {.left = *window};
        const piece_cell z = place_of(of, &d, &of->other->of[k]);
        const ring r = ring_of(&f, &z);
        points_of(&f, &over, &r, d.along, sum_upper(off, z.slack), point);
        status = surface_distance(own, &over, 0, point, &g);
        if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
            return distance_fault(own, status, error);
        if (status == IMP_STATUS_OK)
            one.is_apart =
                distance_cut_heights(&g, 2, &of->times, gamma_clear, &one.left, &one.lower);
        piece_view_join(&all, &one);
    }
    if (!piece_view_is_useless(&all, window)) *view = all;
    return IMP_SUCCESS;
}

/* --- Beside a ball ---------------------------------------------------------------------------- */

/* Lemma. S(t) about the course's line leaves the places (p, q) of z as they are; k.way is added to
 * p. Two points are at least as far apart as their places, and the ball's center is radius away
 * from its points at most. Rounding: as of rings, for both; differences and root 5. */
_Static_assert(2 * (1 + 8 + 4 + 8 + 16 + 8) + 5 <= 2 * RING_ROUNDING, "rounding beside a ball");
imp_code piece_ball_cut(const piece_course *of, const surface *own, double gamma_clear,
                        const time_window *window, piece_view *view, imp_error *error)
{
    const surface_course *c = &of->course;
    const line_frame f = {.center = vec3_from(c->center), .axis = vec3_from(c->axis)};
    imp_model axis[3];
    double lower = INFINITY, radius;
    vec3 at;
    *view = (piece_view){.left = *window};
    if (!c->spins) return IMP_SUCCESS;
    const imp_status status = surface_bare_ball(own, &of->times, at.x, &radius);
    if (status != IMP_STATUS_OK) return distance_fault(own, status, error);
    if (!(radius < INFINITY)) return IMP_SUCCESS;
    for (int i = 0; i < 3; ++i) axis[i] = imp_num(f.axis.x[i]);
    const imp_model way = imp_dot3(axis, c->way);
    const vec3 from = vec3_sub(at, f.center);
    const double p = vec3_dot(from, f.axis), q = vec3_norm(vec3_cross(from, f.axis));
    const double size = of->other->reach + vec3_norm(vec3_from(c->shift)) + vec3_norm(f.center) +
                        vec3_norm(at) + imp_interval_mag(imp_model_range(&way));
    for (size_t k = 0; k < of->other->count; ++k) {
        const piece_cell z = place_of(of, &(drift){.across = 0}, &of->other->of[k]);
        const ring r = ring_of(&f, &z);
        const double above = p - (r.along[1] + way.hi), below = r.along[0] + way.lo - p;
        const double along = above > below ? above : below;
        const double outside = q - r.beside[1], inside = r.beside[0] - q;
        const double beside = outside > inside ? outside : inside;
        const double all =
            sqrt((along > 0 ? along * along : 0) + (beside > 0 ? beside * beside : 0));
        const double d = all - z.slack;
        if (!(d >= lower)) lower = d;
    }
    const double off = padded_upper(radius + c->off + c->wander + of->other->slack +
                                        2 * RING_ROUNDING * UNIT_ROUNDOFF * size,
                                    16);
    view->lower = lower > off ? difference_lower(lower, off) : 0;
    view->is_apart = view->lower > gamma_clear;
    return IMP_SUCCESS;
}
