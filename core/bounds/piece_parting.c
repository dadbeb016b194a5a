/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/piece_planes.h"

/* --- Views ------------------------------------------------------------------------------------ */

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
static void find_facing(const piece_course *of, const piece_shadow *s, piece_hint *hint)
{
    const vec3 *own = of->own->of[hint->piece[0]].corner, middle = middle_of(own);
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
        hint->piece[1] = s->of[k].cell;
    }
}

/* --- All pieces ------------------------------------------------------------------------------- */

/* Tries what the type of a round piece knows of it. */
static imp_code try_round(const piece_course *of, const surface *piece, double gamma_clear,
                          const time_window *window, piece_view *one, imp_error *error)
{
    imp_code (*const more[])(const piece_course *, const surface *, double, const time_window *,
                             piece_view *, imp_error *) = {piece_rings_cut, piece_ball_cut};
    if (surface_inner_maps(piece) > 0) return IMP_SUCCESS;
    for (int k = 0; k < 2 && !one->is_apart; ++k) {
        piece_view found;
        const imp_code code = more[k](of, piece, gamma_clear, window, &found, error);
        if (code != IMP_SUCCESS) return code;
        if (found.is_apart || found.lower > one->lower) *one = found;
    }
    return IMP_SUCCESS;
}

/* Tries the cells of one piece, then what its type knows of a round one. */
static imp_code try_piece(const piece_course *of, const piece_shadow *s, size_t first, size_t end,
                          double gamma_clear, const time_window *window, piece_view *view,
                          imp_error *error)
{
    const piece_cell *cells = of->own->of;
    *view = (piece_view){.is_apart = true, .left = *window, .lower = INFINITY};
    for (size_t k = first; k < end && !piece_view_is_useless(view, window); ++k) {
        piece_view one = {.left = *window};
        piece_planes_of_cell(of, s, &cells[k], gamma_clear, &one);
        one.hint.is_known = true;
        one.hint.piece[0] = k;
        piece_view_join(view, &one);
    }
    const bool is_round = cells[first].is_hoop || cells[first].slack > 0;
    if (view->is_apart || !is_round) return IMP_SUCCESS;
    return try_round(of, surface_part(of->a, of->own->piece[first]), gamma_clear, window, view,
                     error);
}

/* The cell after the last one of the piece of that cell. */
static size_t end_of_piece(const piece_corners *c, size_t k)
{
    const size_t piece = c->piece[k];
    while (k < c->count && c->piece[k] == piece) ++k;
    return k;
}

/* Pieces are taken in a scattered order: one that touches ends it, wherever it lies. */
static imp_code try_all(const piece_course *of, const piece_shadow *s, double gamma_clear,
                        const time_window *window, piece_view *all, imp_error *error)
{
    const size_t n = of->own->count, half = n / 2; /* the step has no divisor in common with n */
    const size_t step = n % 2 == 1 ? half : half % 2 == 1 ? half + 2 : half + 1;
    for (size_t k = 0, at = 0; k < n; ++k, at = (at + step) % n) {
        piece_view one;
        if (at > 0 && of->own->piece[at - 1] == of->own->piece[at]) continue;
        const imp_code code =
            try_piece(of, s, at, end_of_piece(of->own, at), gamma_clear, window, &one, error);
        if (code != IMP_SUCCESS) return code;
        piece_view_join(all, &one);
        if (piece_view_is_useless(all, window)) break;
    }
    return IMP_SUCCESS;
}

imp_code piece_planes_cut(const piece_course *of, double gamma_clear, const time_window *window,
                          piece_view *view, imp_error *error)
{
    piece_shadow s;
    piece_view all = {.is_apart = true, .left = *window, .lower = INFINITY};
    *view = (piece_view){.left = *window};
    if (of->own->count == 0 || of->other->count == 0) return IMP_SUCCESS;
    imp_code code = piece_shadow_take(of, &s, error);
    if (code != IMP_SUCCESS) return code;
    code = try_all(of, &s, gamma_clear, window, &all, error);
    if (!piece_view_is_useless(&all, window)) *view = all;
    if (!view->is_apart) piece_planes_of_all(of, &s, gamma_clear, window, view);
    piece_hint *hint = &view->hint;
    if (hint->is_known) {
        find_facing(of, &s, hint);
        hint->piece[0] = of->own->piece[hint->piece[0]];
        hint->piece[1] = of->other->piece[hint->piece[1]];
    }
    piece_shadow_clear(&s);
    return code;
}
