/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/piece_sides.h"

#include <impinge/model.h>
#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"

/* --- The other surface, as planes see it ------------------------------------------------------ */

/* Points such that the least value of n.x at all times of the course, but for its way and what is
 * left out (lemma below), is that of w.p, w = weights_of(n): the corners where the course does not
 * spin, and else their places along the line and beside it. */
typedef struct shadow_point {
    vec3 p;
    size_t piece; /* whose corner it is */
} shadow_point;

typedef struct shadow {
    shadow_point *of;
    size_t count;
    double reach; /* >= |x| of each corner, seen from a; length */
} shadow;

static vec3 seen_by(const surface_course *c, vec3 y)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = vec3_dot(vec3_from(c->turn[i]), y) + c->shift[i];
    return x;
}

static vec3 weights_of(const surface_course *c, vec3 n)
{
    if (!c->spins) return n;
    const vec3 axis = vec3_from(c->axis);
    return (vec3){{vec3_dot(n, axis), -vec3_norm(vec3_cross(n, axis)), 0}};
}

static int along_line(const void *x, const void *y)
{
    const shadow_point *p = x, *q = y;
    for (int i = 0; i < 2; ++i)
        if (p->p.x[i] != q->p.x[i]) return p->p.x[i] < q->p.x[i] ? -1 : 1;
    return p->piece < q->piece ? -1 : p->piece > q->piece;
}

/* Whether the middle one of three points, ordered along the line, is surely not above the others'
 * chord. Rounding: 2 of each product and 2 of its factors, 1 of the difference. */
PAD_COVERS(16, 2 * 2 + 2 + 1);
static bool is_below(vec3 before, vec3 middle, vec3 after)
{
    const vec3 u = vec3_sub(middle, before), v = vec3_sub(after, before);
    const double rise = u.x[1] * v.x[0], chord = u.x[0] * v.x[1];
    return chord - rise >= 16 * UNIT_ROUNDOFF * (fabs(rise) + fabs(chord));
}

/* Keeps the upper hull, but for points in doubt. Lemma. w.p with w[1] <= 0 is no less at a point
 * than at the better of two others on whose chord, or below, it lies, or at one straight above. */
static void keep_outer(shadow *s)
{
    size_t kept = 0;
    qsort(s->of, s->count, sizeof *s->of, along_line);
    for (size_t k = 0; k < s->count; ++k) {
        const shadow_point next = s->of[k];
        if (kept > 0 && s->of[kept - 1].p.x[0] == next.p.x[0]) kept -= 1;
        while (kept > 1 && is_below(s->of[kept - 2].p, s->of[kept - 1].p, next.p)) kept -= 1;
        s->of[kept++] = next;
    }
    s->count = kept;
}

static imp_code take_shadow(const piece_course *of, shadow *s, imp_error *error)
{
    const surface_course *c = &of->course;
    const vec3 center = vec3_from(c->center), axis = vec3_from(c->axis);
    *s = (shadow){.count = 4 * of->other->count};
    s->of = arena_store_room(of->other->store, s->count * sizeof *s->of);
    if (s->of == NULL) return error_set_memory(error);
    for (size_t k = 0; k < s->count; ++k) {
        const vec3 x = seen_by(c, of->other->of[k / 4][k % 4]), from = vec3_sub(x, center);
        const double size = vec3_norm(x);
        const vec3 places = {{vec3_dot(from, axis), vec3_norm(vec3_cross(from, axis)), 0}};
        s->of[k] = (shadow_point){c->spins ? places : x, k / 4};
        if (size > s->reach) s->reach = size;
    }
    if (c->spins) keep_outer(s);
    return IMP_SUCCESS;
}

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
 * Several pieces have one plane, if x is any corner of them. Rounding, in units of u times |c|,
 * |z|, |x| and what wanders at most: z - c 1; k 8; p 4; cross product 4 and its length 4; n.k and
 * |n x k| 8 + 8 each; products and sum 4; n.c and n.x 4 each; sums 4. Of what is left out: product
 * 1, sums 5, 8. */
enum { PLANE_ROUNDING = 256 };
_Static_assert(1 + 8 + 4 + 8 + 2 * 16 + 4 + 8 + 4 <= PLANE_ROUNDING, "rounding of a plane");
PAD_COVERS(16, 6 + 8);

/* Returns a model over the course that is no greater than the distance from b of pieces with
 * these corners. */
static imp_model beyond(const piece_course *of, const shadow *s, const vec3 *corner, size_t corners,
                        vec3 n, size_t *nearest)
{
    const surface_course *c = &of->course;
    const vec3 w = weights_of(c, n);
    double least = INFINITY, most = -INFINITY;
    imp_model axis[3];
    for (size_t k = 0; k < s->count; ++k) {
        const double here = vec3_dot(w, s->of[k].p);
        if (!(here >= least)) least = here, *nearest = s->of[k].piece;
    }
    for (size_t k = 0; k < corners; ++k) {
        const double here = vec3_dot(n, corner[k]);
        if (!(here <= most)) most = here;
    }
    for (int i = 0; i < 3; ++i) axis[i] = imp_num(n.x[i]);
    const double at = c->spins ? vec3_dot(n, vec3_from(c->center)) : 0;
    const double center = c->spins ? vec3_norm(vec3_from(c->center)) : 0;
    const double size = s->reach + of->own->reach + center + c->wander;
    const double wander = c->wander > 0 ? c->wander * -w.x[1] : 0;
    const double off = padded_upper(c->off + wander + of->own->slack + of->other->slack +
                                        PLANE_ROUNDING * UNIT_ROUNDOFF * size,
                                    16);
    const imp_model g = imp_shift(imp_dot3(axis, c->way), least + at - most - off);
    return imp_scale(g, 1 - 0x1p-48);
}

/* Whether a plane with that normal parts the pieces from b at some times of the window; view->left
 * becomes the others. */
static bool part_by(const piece_course *of, const shadow *s, const vec3 *corner, size_t corners,
                    vec3 n, double gamma_clear, piece_view *view)
{
    const time_window whole = view->left;
    const imp_model g = beyond(of, s, corner, corners, n, &view->hint.piece[1]);
    view->is_apart =
        distance_cut_heights(&g, 1, &of->times, gamma_clear, &view->left, &view->lower);
    return view->is_apart || view->lower > 0 || view->left.lo > whole.lo ||
           view->left.hi < whole.hi;
}

/* --- All planes ------------------------------------------------------------------------------- */

void piece_view_join(piece_view *all, const piece_view *one)
{
    if (one->lower < all->lower) {
        all->lower = one->lower;
        all->hint = one->hint;
    }
    if (one->is_apart) return;
    if (all->is_apart || one->left.lo < all->left.lo) all->left.lo = one->left.lo;
    if (all->is_apart || one->left.hi > all->left.hi) all->left.hi = one->left.hi;
    all->is_apart = false;
}

bool piece_view_is_useless(const piece_view *view, const time_window *window)
{
    return !view->is_apart && !(view->lower > 0) && view->left.lo <= window->lo &&
           view->left.hi >= window->hi;
}

/* A unit vector across the piece, on either side. False: there is none. */
static bool across_piece(const vec3 corner[4], int side, vec3 *n)
{
    const vec3 across = vec3_cross(vec3_sub(corner[3], corner[0]), vec3_sub(corner[2], corner[1]));
    const double length = vec3_norm(across);
    *n = vec3_scale(across, (side == 0 ? 1 : -1) / length);
    return length > 0x1p-500 && length < INFINITY;
}

static void try_piece(const piece_course *of, const shadow *s, const vec3 corner[4],
                      double gamma_clear, piece_view *one)
{
    const time_window window = one->left;
    vec3 n;
    for (int side = 0; side < 2 && across_piece(corner, side, &n); ++side) {
        *one = (piece_view){.left = window};
        if (part_by(of, s, corner, 4, n, gamma_clear, one)) return;
    }
}

/* --- One plane for all pieces ----------------------------------------------------------------- */

/* Its cost grows with the square of their number. */
enum { PIECES_AT_ONCE = 32 };

/* About how far a plane with that normal is from b, all of a being behind it, at the middle of the
 * times. */
static double about_beyond(const piece_course *of, const shadow *s, vec3 n)
{
    const surface_course *c = &of->course;
    const vec3 w = weights_of(c, n), way = {{c->way[0].a, c->way[1].a, c->way[2].a}};
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < s->count; ++k)
        if (vec3_dot(w, s->of[k].p) < least) least = vec3_dot(w, s->of[k].p);
    for (size_t k = 0; k < 4 * of->own->count; ++k) {
        const double here = vec3_dot(n, of->own->of[k / 4][k % 4]);
        if (here > most) most = here;
    }
    const double at = c->spins ? vec3_dot(n, vec3_from(c->center)) : 0;
    return least - most + at + vec3_dot(n, way) -
           c->wander * vec3_norm(vec3_cross(n, vec3_from(c->axis)));
}

/* Tries the plane of that piece which is farthest from b if all of a is behind it: side pieces of a
 * convex body have no plane of their own that parts them from what is in front of another. Adds
 * what it shows to *all. */
static void try_together(const piece_course *of, const shadow *s, double gamma_clear,
                         const time_window *window, piece_view *all)
{
    const size_t count = of->own->count;
    piece_view view = {.left = *window};
    vec3 best = {{0, 0, 0}}, n;
    double most = 0;
    if (count == 1 || count > PIECES_AT_ONCE || of->other->count > PIECES_AT_ONCE) return;
    for (size_t k = 0; k < 2 * count; ++k) {
        if (!across_piece(of->own->of[k / 2], (int)(k % 2), &n)) continue;
        const double here = about_beyond(of, s, n);
        if (!(here > most)) continue;
        most = here, best = n;
        view.hint.piece[0] = k / 2;
    }
    if (!(most > 0)) return;
    part_by(of, s, of->own->of[0], 4 * count, best, gamma_clear, &view);
    view.hint.is_known = true;
    if (view.is_apart || view.lower > all->lower) *all = view;
}

/* --- Which pieces are nearest ----------------------------------------------------------------- */

static vec3 middle_of(const vec3 corner[4])
{
    const vec3 sum = vec3_add(vec3_add(corner[0], corner[1]), vec3_add(corner[2], corner[3]));
    return vec3_scale(sum, 0.25);
}

/* A corner nearer than this part of the sizes to the nearest one counts as near. */
#define NEARLY 0x1p-30

/* Many pieces have a corner that is nearest to a plane; the one whose middle is nearest to that of
 * the plane's piece faces it. Where the course spins, that depends on the time. */
static void find_facing(const piece_course *of, const shadow *s, piece_hint *hint)
{
    const vec3 *own = of->own->of[hint->piece[0]], middle = middle_of(own);
    const vec3 across = vec3_cross(vec3_sub(own[3], own[0]), vec3_sub(own[2], own[1]));
    const vec3 way = {{of->course.way[0].a, of->course.way[1].a, of->course.way[2].a}};
    const size_t near = hint->piece[1];
    double least = INFINITY, best = INFINITY;
    if (of->course.spins) return;
    const vec3 to = vec3_sub(vec3_add(s->of[4 * near].p, way), middle);
    const vec3 n = vec3_scale(across, vec3_dot(across, to) < 0 ? -1 : 1);
    for (size_t k = 0; k < s->count; ++k)
        if (vec3_dot(n, s->of[k].p) < least) least = vec3_dot(n, s->of[k].p);
    const double room = NEARLY * vec3_norm(n) * (s->reach + of->own->reach);
    for (size_t k = 0; k < s->count; ++k) {
        vec3 corner[4];
        if (!(vec3_dot(n, s->of[k].p) <= least + room)) continue;
        for (int j = 0; j < 4; ++j) corner[j] = vec3_add(s->of[k / 4 * 4 + (size_t)j].p, way);
        const double apart = vec3_norm(vec3_sub(middle_of(corner), middle));
        if (!(apart < best)) continue;
        best = apart;
        hint->piece[1] = s->of[k].piece;
    }
}

/* Pieces are taken in a scattered order: one that touches ends it, wherever it lies. */
imp_code piece_planes_cut(const piece_course *of, double gamma_clear, const time_window *window,
                          piece_view *view, imp_error *error)
{
    shadow s;
    const size_t n = of->own->count, half = n / 2; /* the step has no divisor in common with n */
    const size_t step = n % 2 == 1 ? half : half % 2 == 1 ? half + 2 : half + 1;
    piece_view all = {.is_apart = true, .left = *window, .lower = INFINITY};
    *view = (piece_view){.left = *window};
    if (n == 0 || of->other->count == 0) return IMP_SUCCESS;
    const imp_code code = take_shadow(of, &s, error);
    if (code != IMP_SUCCESS) return code;
    for (size_t k = 0, at = 0; k < n; ++k, at = (at + step) % n) {
        piece_view one = {.left = *window};
        try_piece(of, &s, of->own->of[at], gamma_clear, &one);
        one.hint.is_known = true;
        one.hint.piece[0] = at;
        piece_view_join(&all, &one);
        if (piece_view_is_useless(&all, window)) break;
    }
    if (!piece_view_is_useless(&all, window)) *view = all;
    if (!view->is_apart) try_together(of, &s, gamma_clear, window, view);
    if (view->hint.is_known) find_facing(of, &s, &view->hint);
    arena_store_free_room(of->other->store, s.of);
    return IMP_SUCCESS;
}
