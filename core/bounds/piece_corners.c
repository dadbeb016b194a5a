/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/bounds/piece_sides.h"
#include "core/surface/carried.h"
#include "core/surface/course.h"

/* --- One cell --------------------------------------------------------------------------------- */

/* Lemma. a + b_u s + b_v r + q_uv s r is bilinear: over the square a convex combination of its
 * values at the four corners. What else a model has is at most e + |q_uu| + |q_vv|, coordinate by
 * coordinate. Roundings: 3 sums of a corner, 8 of the slack, squares, sums and root of it. */
enum { CORNER_ROUNDING = 8 };
PAD_COVERS(16, 8 + 3 + 2);

bool piece_cell_of(const imp_model x[3], piece_cell *cell)
{
    double sum = 0;
    *cell = (piece_cell){.is_hoop = false};
    for (int i = 0; i < 3; ++i) {
        const imp_model *m = &x[i];
        const double uv = m->q[IMP_UV],
                     size = fabs(m->a) + fabs(m->b[0]) + fabs(m->b[1]) + fabs(uv);
        const double in_time = fabs(m->b[2]) + fabs(m->q[IMP_UT]) + fabs(m->q[IMP_VT]) +
                               fabs(m->q[IMP_TT]); /* 0, unless the type contradicts itself */
        const double more = m->e + fabs(m->q[IMP_UU]) + fabs(m->q[IMP_VV]) + in_time +
                            CORNER_ROUNDING * UNIT_ROUNDOFF * size;
        if ((m->depends >> PARAMETER_T & 1) != 0 || !(size + more < 0x1p200)) return false;
        sum += more * more;
        for (int k = 0; k < 4; ++k) {
            const double s = k / 2 == 0 ? -1 : 1, r = k % 2 == 0 ? -1 : 1;
            cell->corner[k].x[i] = m->a + s * m->b[0] + r * m->b[1] + s * r * uv;
        }
    }
    cell->slack = padded_upper(sqrt(sum), 16) + ROOT_UNDERFLOW;
    return true;
}

/* False: it moves by itself, or has no bounds. */
static bool take_cell(const surface *piece, const imp_region *all, piece_cell *cell,
                      imp_status *status)
{
    imp_model x[3];
    *cell = (piece_cell){.is_hoop = false};
    *status = surface_include_inner(piece, all, surface_inner_maps(piece), x);
    return *status == IMP_STATUS_OK && piece_cell_of(x, cell);
}

/* Lemma. Points of one orbit are images of each other by rotations about the line, so a point of
 * the piece is one of the cell, turned by some angle: within `slack` of sum w_k x_k, turned, and
 * x_k turned is on the circle of x_k about the line. Rounding of a circle's center and radius, in
 * units of u times |c| + |x_k - c|: x_k - c 1; axis 8, place along it 4, product and sum 2; cross
 * product 4, and its length 4. */
enum { HOOP_ROUNDING = 32 };
_Static_assert(1 + 8 + 4 + 2 + 4 + 4 <= HOOP_ROUNDING, "rounding of a hoop");
PAD_COVERS(16, 6);

static void make_hoop(piece_cell *cell, const imp_symmetry *line)
{
    const vec3 center = vec3_from(line->center), way = vec3_from(line->axis);
    double far = 0;
    cell->is_hoop = true;
    cell->axis = vec3_scale(way, 1 / vec3_norm(way));
    for (int k = 0; k < 4; ++k) {
        const vec3 from = vec3_sub(cell->corner[k], center);
        const double size = vec3_norm(from);
        if (size > far) far = size;
        cell->radius[k] = vec3_norm(vec3_cross(from, cell->axis));
        cell->corner[k] = vec3_add(center, vec3_scale(cell->axis, vec3_dot(from, cell->axis)));
    }
    cell->slack =
        padded_upper(cell->slack + HOOP_ROUNDING * UNIT_ROUNDOFF * (vec3_norm(center) + far), 16);
}

vec3 piece_circle_lowest(vec3 center, vec3 axis, double radius, vec3 n)
{
    const vec3 across = vec3_sub(n, vec3_scale(axis, vec3_dot(n, axis)));
    const double length = vec3_norm(across);
    return length > 0 ? vec3_sub(center, vec3_scale(across, radius / length)) : center;
}

/* --- Pieces ----------------------------------------------------------------------------------- */

/* A piece that is off by more than this part of its size is round: divided into this many hoops, if
 * one point may stand for its orbit. More than that many pieces are all taken as they are. */
#define IS_ROUND 0x1p-20
enum { HOOPS_OF_ONE = 16, ROUND_PIECES = 16 };

static double size_of(const piece_cell *cell)
{
    double size = 0;
    for (int k = 1; k < 4; ++k) size += vec3_norm(vec3_sub(cell->corner[k], cell->corner[0]));
    return size;
}

static double reach_of(const piece_cell *cell)
{
    double reach = 0;
    for (int k = 0; k < 4; ++k) {
        const double size = vec3_norm(cell->corner[k]) + cell->radius[k];
        if (size > reach) reach = size;
    }
    return reach + cell->slack;
}

static imp_region all_of(const surface *piece, const time_window *times)
{
    double lo[3], hi[3];
    surface_domain(piece, lo, hi);
    lo[2] = times->lo, hi[2] = times->hi;
    return region_make(lo, hi);
}

/* Takes part k of `parts` of the piece's points with one value of the parameter `held`. */
static bool take_part(const surface *piece, const imp_region *all, int held, int k, int parts,
                      const imp_symmetry *line, piece_cell *cell, imp_status *status)
{
    double lo[3], hi[3];
    memcpy(lo, all->lo, sizeof lo);
    memcpy(hi, all->hi, sizeof hi);
    const double from = lo[!held], to = hi[!held];
    lo[held] = hi[held] = all->c[held];
    if (k > 0) lo[!held] = from + (to - from) * k / parts;
    if (k + 1 < parts) hi[!held] = from + (to - from) * (k + 1) / parts;
    const imp_region part = region_make(lo, hi);
    if (!take_cell(piece, &part, cell, status)) return false;
    make_hoop(cell, line);
    return true;
}

/* Takes a piece of which one point stands for its orbit as one hoop, or several. *count stays 0: it
 * is none. */
static void take_hoops(const surface *piece, const time_window *times,
                       piece_cell cells[HOOPS_OF_ONE], size_t *count, imp_status *status)
{
    imp_symmetry line;
    if (surface_inner_maps(piece) > 0 || !surface_has_symmetry(piece)) return;
    *status = surface_symmetry(piece, &line);
    if (*status != IMP_STATUS_OK || (line.is_closed & IMP_SYMMETRY_NEARLY) != 0) return;
    const bool u = (line.is_closed & IMP_SYMMETRY_ORBIT_U) != 0;
    if (!u && (line.is_closed & IMP_SYMMETRY_ORBIT_V) == 0) return;
    const int held = u ? PARAMETER_U : PARAMETER_V;
    const imp_region all = all_of(piece, times);
    for (int parts = 1; parts <= HOOPS_OF_ONE; parts *= HOOPS_OF_ONE) {
        *count = 0;
        for (int k = 0; k < parts; ++k)
            if (!take_part(piece, &all, held, k, parts, &line, &cells[k], status)) return;
        *count = (size_t)parts;
        if (!(cells[0].slack > IS_ROUND * (size_of(&cells[0]) + cells[0].radius[0]))) return;
    }
}

/* Takes one piece; the slack of one that is flat counts for the surface. */
static bool take_piece(const surface *piece, const time_window *times, bool seeks_hoops,
                       piece_corners *into, size_t k, imp_status *status)
{
    piece_cell *cell = &into->of[into->count];
    const imp_region all = all_of(piece, times);
    size_t hoops = 0;
    if (!take_cell(piece, &all, cell, status)) return false;
    if (!(cell->slack > IS_ROUND * size_of(cell))) {
        if (cell->slack > into->slack) into->slack = cell->slack;
        cell->slack = 0;
    } else if (seeks_hoops) {
        piece_cell found[HOOPS_OF_ONE];
        take_hoops(piece, times, found, &hoops, status);
        if (*status == IMP_STATUS_UNBOUNDED) *status = IMP_STATUS_OK, hoops = 0;
        if (*status != IMP_STATUS_OK) return false;
        memcpy(cell, found, hoops * sizeof *found);
    }
    const size_t cells = hoops > 0 ? hoops : 1;
    for (size_t j = 0; j < cells; ++j) {
        const double reach = reach_of(&cell[j]);
        into->piece[into->count + j] = k;
        if (reach > into->reach) into->reach = reach;
    }
    into->count += cells;
    return true;
}

imp_code piece_corners_take(const surface *s, const time_window *times, size_t most,
                            arena_store *store, piece_corners *corners, bool *known,
                            imp_error *error)
{
    const size_t all = surface_part_count(s);
    const size_t pieces = all < most ? all : most;
    const bool seeks_hoops = all <= ROUND_PIECES;
    const size_t room = pieces * (seeks_hoops ? HOOPS_OF_ONE : 1);
    *corners = (piece_corners){.store = store};
    *known = false;
    corners->of = arena_store_room(store, room * (sizeof *corners->of + sizeof *corners->piece));
    if (corners->of == NULL) return error_set_memory(error);
    corners->piece = (size_t *)(void *)(corners->of + room);
    for (size_t k = 0; k < pieces; ++k) {
        const size_t at = k * all / pieces;
        const surface *piece = surface_part(s, at);
        imp_status status;
        if (!take_piece(piece, times, seeks_hoops, corners, at, &status))
            return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED
                       ? IMP_SUCCESS
                       : distance_fault(piece, status, error);
    }
    *known = true;
    return IMP_SUCCESS;
}

void piece_corners_clear(piece_corners *corners)
{
    arena_store_free_room(corners->store, corners->of);
    corners->of = NULL;
}
