/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/piece_sides.h"

#include <impinge/model.h>
#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/surface/course_line.h"

/* --- Both sides ------------------------------------------------------------------------------- */

typedef struct piece_search {
    const distance_sides *of;
    double gamma_clear;
    time_window times;
    surface_course course[2]; /* of the other side, as this one sees it */
    piece_corners whole[2];   /* of all pieces, where find_bare took them; else none */
} piece_search;

static imp_code cut_side(const piece_search *q, const piece_corners corners[2], int side,
                         const time_window *window, piece_view *view, imp_error *error)
{
    const surface *own = q->of->root[side]->surface;
    const piece_course of = {
        .a = own,
        .b = q->of->root[!side]->surface,
        .own = &corners[side],
        .other = &corners[!side],
        .course = q->course[side],
        .times = region_make((double[3]){-1, -1, q->times.lo}, (double[3]){1, 1, q->times.hi})};
    return piece_planes_cut(&of, q->gamma_clear, window, view, error);
}

/* Whether the corners of all pieces, and no more than `most`, are there already. */
static bool has_corners(const piece_search *q, int side, size_t most)
{
    return q->whole[side].of != NULL && surface_piece_count(q->of->root[side]->surface) <= most;
}

/* Cuts by each side with at most `most` pieces of either. */
static imp_code cut_with(const piece_search *q, size_t most, bool sides[2], distance_outcome *seen,
                         imp_error *error)
{
    piece_corners corners[2] = {{.of = NULL}, {.of = NULL}};
    bool known = true;
    imp_code code = IMP_SUCCESS;
    for (int side = 0; side < 2 && code == IMP_SUCCESS && known; ++side) {
        if (has_corners(q, side, most))
            corners[side] = q->whole[side];
        else
            code = piece_corners_take(q->of->root[side]->surface, &q->times, most, q->of->store,
                                      &corners[side], &known, error);
    }
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        piece_view view;
        sides[side] = sides[side] && known && q->course[side].is_known;
        if (!sides[side] || seen->is_apart) continue;
        const time_window window = seen->left;
        code = cut_side(q, corners, side, &window, &view, error);
        sides[side] = !piece_view_is_useless(&view, &window);
        if (view.is_apart || view.lower > seen->lower) {
            const size_t *piece = view.hint.piece;
            seen->lower = view.lower;
            seen->hint = (piece_hint){view.hint.is_known, {piece[side], piece[!side]}};
        }
        seen->is_apart = view.is_apart;
        if (!view.is_apart) seen->left = view.left;
    }
    for (int side = 0; side < 2; ++side)
        if (!has_corners(q, side, most)) piece_corners_clear(&corners[side]);
    return code;
}

/* Models of a side's points before its last maps. Corners that it needs are kept. */
static imp_code find_bare(piece_search *q, int side, imp_model bare[3], bool *known,
                          imp_error *error)
{
    const node *root = q->of->root[side];
    piece_corners *corners = &q->whole[side];
    if (surface_inner_maps(root->surface) == 0) {
        *known = node_bare_models(root, bare);
        return IMP_SUCCESS;
    }
    const imp_code code = piece_corners_take(root->surface, &q->times, PIECES_MOST, q->of->store,
                                             corners, known, error);
    const double most = sum_upper(corners->reach * (1 + 0x1p-40), corners->slack);
    for (int i = 0; i < 3; ++i) bare[i] = imp_between(-most, most);
    if (!*known) piece_corners_clear(corners);
    return code;
}

static imp_code find_courses(piece_search *q, imp_error *error)
{
    const imp_region times =
        region_make((double[3]){-1, -1, q->times.lo}, (double[3]){1, 1, q->times.hi});
    const double moment = 0.5 * q->times.lo + 0.5 * q->times.hi;
    const surface *const s[2] = {q->of->root[0]->surface, q->of->root[1]->surface};
    imp_model bare[2][3];
    bool known[2];
    for (int side = 0; side < 2; ++side) {
        const imp_code code = find_bare(q, side, bare[side], &known[side], error);
        if (code != IMP_SUCCESS) return code;
        q->course[side].is_known = false;
    }
    if (!course_is_likely(s[0], s[1], &times)) return IMP_SUCCESS;
    for (int side = 0; side < 2; ++side) {
        if (!known[!side]) continue;
        const imp_status status =
            surface_course_of(s[side], s[!side], bare[!side], &times, moment, &q->course[side]);
        if (status != IMP_STATUS_OK) return distance_fault(s[!side], status, error);
    }
    return IMP_SUCCESS;
}

/* Some pieces in which a side shows nothing spare it all of them. */
enum { PIECES_FIRST = 12 };

static imp_code cut_sides(piece_search *q, size_t most, distance_outcome *seen, imp_error *error)
{
    bool sides[2] = {true, true};
    imp_code code = find_courses(q, error);
    if (!q->course[0].is_known && !q->course[1].is_known) return code;
    if (code == IMP_SUCCESS && most > PIECES_FIRST) {
        distance_outcome some = *seen;
        code = cut_with(q, PIECES_FIRST, sides, &some, error);
    }
    if (code != IMP_SUCCESS || (!sides[0] && !sides[1])) return code;
    return cut_with(q, most, sides, seen, error);
}

imp_code piece_sides_cut(const distance_sides *of, unsigned search, double gamma_clear,
                         distance_outcome *seen, imp_error *error)
{
    const surface *const s[2] = {of->root[0]->surface, of->root[1]->surface};
    piece_search q = {
        .of = of, .gamma_clear = gamma_clear, .times = pair_times(of->root[0], of->root[1])};
    size_t most = 1;
    if ((of->slips->searches & search) != 0 || !of->takes_orbits) return IMP_SUCCESS;
    of->slips->searches = (unsigned char)(of->slips->searches | search);
    for (int side = 0; side < 2; ++side)
        if (surface_piece_count(s[side]) > most) most = surface_piece_count(s[side]);
    if (most == 1 || most > PIECES_MOST || surface_common_maps(s[0], s[1]) > 0) return IMP_SUCCESS;
    const imp_code code = cut_sides(&q, most, seen, error);
    for (int side = 0; side < 2; ++side) piece_corners_clear(&q.whole[side]);
    return code;
}
