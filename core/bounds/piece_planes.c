/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/bounds/gjk.h"
#include "core/bounds/piece_planes.h"

/* --- One plane -------------------------------------------------------------------------------- */

/* Lemma. Let |n| = 1 but for 8 u, x a point of a's piece and y one of b, S(t) the course's rotation
 * about its line, z = turn y + shift, and h = n.way(t). A point z has the place p = k.(z - c) along
 * the line and the distance q beside it, k the line's unit vector, c its center; S z has the same,
 * and n.(S z - c) >= (n.k) p - |n x k| q. That is concave in z, so its least value over the convex
 * hull of corners is at one of them, and points within `slack` of it lose at most that much, as the
 * slope is |n| long. So, at all times,
 *
 *   |y - x| (1 + 8 u) >= n.(S z + way - x) - off
 *                     >= min over corners (n.k) p - |n x k| q + n.c + h - max over corners n.x
 *                        - (off + both slacks) (1 + 8 u);
 *
 * where the course does not spin, n.z stands for the first terms and n.c. What wanders across the
 * line loses |n x k| of its length: nothing but rounding, if the plane is across the line, too.
 * Several pieces have one plane, if x is any corner of them. A hoop's corner x has the circle of
 * radius r about its axis, across m: n.x is then at most r |n x m| more, and each cell's slack
 * counts for itself. Rounding, in units of u times |c|, |z|, |x|, radii and what wanders at most: z
 * - c 1; k 8; p 4; cross product 4 and its length 4; n.k and |n x k| 8 + 8 each; products and sum
 * 4; n.c and n.x 4 each; sums 4; of a hoop a center 4, |n x m| 16, product and sums 4, sines 16 and
 * their product and sums 5 (piece_shadow.c). Of what is left out: product 1, sums 5, 8. */
enum { PLANE_ROUNDING = 256 };
_Static_assert(1 + 8 + 4 + 8 + 2 * 16 + 4 + 8 + 4 + 4 + 16 + 4 + 16 + 5 <= PLANE_ROUNDING,
               "rounding of a plane");
PAD_COVERS(16, 6 + 8);

/* Some cells of a. */
typedef struct some_cells {
    const piece_cell *of;
    size_t count;
} some_cells;

static double most_along(some_cells own, vec3 n)
{
    double most = -INFINITY;
    for (size_t k = 0; k < own.count; ++k) {
        const piece_cell *cell = &own.of[k];
        const double sine = cell->is_hoop ? vec3_norm(vec3_cross(n, cell->axis)) : 0;
        for (int j = 0; j < 4; ++j) {
            const double here = vec3_dot(n, cell->corner[j]) + cell->radius[j] * sine + cell->slack;
            if (!(here <= most)) most = here;
        }
    }
    return most;
}

/* Returns a model over the course that is no greater than the distance of the cells from b. */
static imp_model beyond(const piece_course *of, const piece_shadow *s, some_cells own, vec3 n,
                        size_t *nearest)
{
    const surface_course *c = &of->course;
    const double least = piece_shadow_least(s, n, nearest), most = most_along(own, n);
    imp_model axis[3];
    for (int i = 0; i < 3; ++i) axis[i] = imp_num(n.x[i]);
    const double at = c->spins ? vec3_dot(n, vec3_from(c->center)) : 0;
    const double center = c->spins ? vec3_norm(vec3_from(c->center)) : 0;
    const double size = s->reach + of->own->reach + center + c->wander;
    const double wander =
        c->wander > 0 ? c->wander * vec3_norm(vec3_cross(n, vec3_from(c->axis))) : 0;
    const double off = padded_upper(c->off + wander + of->own->slack + of->other->slack +
                                        PLANE_ROUNDING * UNIT_ROUNDOFF * size,
                                    16);
    const imp_model g = imp_shift(imp_dot3(axis, c->way), least + at - most - off);
    return imp_scale(g, 1 - 0x1p-48);
}

/* Leaves of view->left the times at which no plane with that normal parts the cells from b. */
static void part_by(const piece_course *of, const piece_shadow *s, some_cells own, vec3 n,
                    double gamma_clear, piece_view *view)
{
    const imp_model g = beyond(of, s, own, n, &view->hint.piece[1]);
    view->is_apart =
        distance_cut_heights(&g, 1, &of->times, gamma_clear, &view->left, &view->lower);
}

/* A unit vector across the cell, on either side; of a hoop, along its line. False: there is
 * none. */
static bool across_cell(const piece_cell *cell, int side, vec3 *n)
{
    const vec3 *x = cell->corner;
    const vec3 across =
        cell->is_hoop ? cell->axis : vec3_cross(vec3_sub(x[3], x[0]), vec3_sub(x[2], x[1]));
    const double length = vec3_norm(across);
    *n = vec3_scale(across, (side == 0 ? 1 : -1) / length);
    return length > 0x1p-500 && length < INFINITY;
}

/* --- The best plane --------------------------------------------------------------------------- */

/* What b sweeps, less cells of a. The way that b has gone counts from one end of the course to the
 * other. */
typedef struct swept_gap {
    const piece_shadow *s;
    some_cells own;
    vec3 way[2];
} swept_gap;

static vec3 lowest_gap(const void *set, vec3 n)
{
    const swept_gap *g = set;
    const vec3 back = vec3_scale(n, -1);
    const vec3 way = vec3_dot(n, g->way[0]) < vec3_dot(n, g->way[1]) ? g->way[0] : g->way[1];
    const vec3 low = vec3_add(piece_shadow_lowest(g->s, n), way);
    double most = -INFINITY;
    vec3 high = {{0, 0, 0}};
    for (size_t k = 0; k < g->own.count; ++k)
        for (int j = 0; j < 4; ++j) {
            const piece_cell *cell = &g->own.of[k];
            const vec3 x = cell->is_hoop ? piece_circle_lowest(cell->corner[j], cell->axis,
                                                               cell->radius[j], back)
                                         : cell->corner[j];
            if (vec3_dot(n, x) > most) most = vec3_dot(n, x), high = x;
        }
    return vec3_sub(low, high);
}

/* The gap along the axis is at least this share of the distance of the sets. A clearance whose
 * bracket is a thousandth wide needs no more. */
#define GAP_SHARE (1 - 0x1p-14)

/* Finds the axis along which the cells are farthest from what b sweeps, by GJK. False: these
 * meet. */
static bool find_axis(const piece_course *of, const piece_shadow *s, some_cells own, vec3 *n)
{
    swept_gap g = {.s = s, .own = own};
    for (int k = 0; k < 2; ++k) {
        const double w = k == 0 ? -1 : 1;
        for (int i = 0; i < 3; ++i) {
            const imp_model *way = &of->course.way[i];
            g.way[k].x[i] = way->a + w * way->b[PARAMETER_T] + way->q[IMP_TT];
        }
    }
    vec3 axis = vec3_sub(piece_shadow_lowest(s, (vec3){{1, 0, 0}}), own.of[0].corner[0]);
    if (!gjk_search(lowest_gap, &g, GAP_SHARE, &axis)) return false;
    const double length = vec3_norm(axis);
    *n = vec3_scale(axis, 1 / length);
    return length > 0x1p-500 && length < INFINITY;
}

/* An axis is sought for cells that no plane of their own parts, unless that is too much work: GJK
 * looks at all of the other surface some ten times. */
enum { AXES_MOST = 1 << 16 };

/* What two planes show together. */
static void piece_view_meet(piece_view *view, const piece_view *other)
{
    if (other->is_apart || (!view->is_apart && other->lower > view->lower)) {
        view->lower = other->lower;
        view->hint = other->hint;
    }
    view->is_apart = view->is_apart || other->is_apart;
    if (other->left.lo > view->left.lo) view->left.lo = other->left.lo;
    if (other->left.hi < view->left.hi) view->left.hi = other->left.hi;
    view->is_apart = view->is_apart || view->left.lo > view->left.hi;
}

void piece_planes_of_cell(const piece_course *of, const piece_shadow *s, const piece_cell *cell,
                          double gamma_clear, piece_view *one)
{
    const some_cells own = {cell, 1};
    const time_window window = one->left;
    piece_view view;
    vec3 n;
    for (int side = 0; side < 2 && !one->is_apart && across_cell(cell, side, &n); ++side) {
        view = (piece_view){.left = window};
        part_by(of, s, own, n, gamma_clear, &view);
        piece_view_meet(one, &view);
    }
    if (one->is_apart || of->own->count * s->count > AXES_MOST || !find_axis(of, s, own, &n))
        return;
    view = (piece_view){.left = window};
    part_by(of, s, own, n, gamma_clear, &view);
    piece_view_meet(one, &view);
}

/* --- One plane for all pieces ----------------------------------------------------------------- */

/* Its cost grows with the square of their number. */
enum { PIECES_AT_ONCE = 32 };

/* About how far a plane with that normal is from b, all of a being behind it, at the middle of the
 * times. */
static double about_beyond(const piece_course *of, const piece_shadow *s, some_cells own, vec3 n)
{
    const surface_course *c = &of->course;
    const vec3 way = {{c->way[0].a, c->way[1].a, c->way[2].a}};
    size_t nearest;
    const double at = c->spins ? vec3_dot(n, vec3_from(c->center)) : 0;
    return piece_shadow_least(s, n, &nearest) - most_along(own, n) + at + vec3_dot(n, way) -
           c->wander * vec3_norm(vec3_cross(n, vec3_from(c->axis)));
}

void piece_planes_of_all(const piece_course *of, const piece_shadow *s, double gamma_clear,
                         const time_window *window, piece_view *all)
{
    const size_t count = of->own->count;
    const some_cells own = {of->own->of, count};
    const bool is_small = count <= PIECES_AT_ONCE && of->other->count <= PIECES_AT_ONCE;
    piece_view view = {.left = *window};
    vec3 best = {{0, 0, 0}}, n;
    double most = 0;
    if (count == 1) return;
    for (size_t k = 0; k < 2 * count && is_small; ++k) {
        if (!across_cell(&own.of[k / 2], (int)(k % 2), &n)) continue;
        const double here = about_beyond(of, s, own, n);
        if (!(here > most)) continue;
        most = here, best = n;
        view.hint.piece[0] = k / 2;
    }
    if (!(most > 0) && !find_axis(of, s, own, &best)) return;
    part_by(of, s, own, best, gamma_clear, &view);
    view.hint.is_known = most > 0;
    if (view.is_apart || view.lower > all->lower) *all = view;
}
