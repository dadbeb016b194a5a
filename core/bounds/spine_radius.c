/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/bounds/piece_sides.h"
#include "core/bounds/quadratic.h"
#include "core/bounds/spine.h"

/* Segment and radius of a spine that hold for all points of its surface: branch and bound over
 * cells of the surface. */

/* --- One cell --------------------------------------------------------------------------------- */

/* What holds for the points of a cell. */
typedef struct reach {
    double radius; /* >= their distance from the line */
    double lo, hi; /* their places along it; length */
} reach;

/* Lemma. Each point is within `slack` of a convex combination of the corners (piece_cell_of), and
 * the distance from a line is convex: it is at most the greatest of the corners' and the slack.
 * Places along the line are linear. Rounding, in units of u (|center| + |corner - center|): the
 * difference 1; axis 8, cross product 4, length 4; or axis 16, since z counts lengths of the axis,
 * and product 3. */
enum { REACH_ROUNDING = 32 };
_Static_assert(1 + 8 + 4 + 4 <= REACH_ROUNDING && 1 + 16 + 3 <= REACH_ROUNDING, "of a reach");
PAD_COVERS(16, 4); /* of the sums */

static reach reach_of_corners(const spine *of, const piece_cell *cell)
{
    const vec3 center = vec3_from(of->center), axis = vec3_from(of->axis);
    reach r = {0, INFINITY, -INFINITY};
    double far = 0;
    for (int k = 0; k < 4; ++k) {
        const vec3 from = vec3_sub(cell->corner[k], center);
        const double z = vec3_dot(from, axis), q = vec3_norm(vec3_cross(from, axis));
        const double size = vec3_norm(from);
        if (size > far) far = size;
        if (q > r.radius) r.radius = q;
        if (z < r.lo) r.lo = z;
        if (z > r.hi) r.hi = z;
    }
    const double off =
        padded_upper(cell->slack + REACH_ROUNDING * UNIT_ROUNDOFF * (vec3_norm(center) + far), 16);
    r.radius = sum_upper(r.radius, off) + ROOT_UNDERFLOW;
    r.lo = difference_lower(r.lo, off);
    r.hi = sum_upper(r.hi, off);
    return r;
}

/* Lemma. Let p be the quadratic of |(x - center) x axis|^2 as the cell's models give it, e its
 * remainder. Its greatest value over the square is the negative of the least of -p (quadratic.h).
 * |axis| >= 1 - 8 u. Roundings of the bound: 4 sums of 4 S at most, S the sum of sizes, besides
 * QUADRATIC_ROUNDING; of the root 1, and the axis 8. */
PAD_COVERS(16, 9 + 1); /* S */
PAD_COVERS(32, 1 + 8);
static double radius_of_square(const spine *of, const imp_model x[3])
{
    imp_model way[3], across[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(x[i], -of->center[i]);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[i] = imp_sub(imp_scale(way[j], of->axis[k]), imp_scale(way[k], of->axis[j]));
    }
    const imp_model square = imp_dot3(across, across);
    const double *b = square.b, *q = square.q;
    double size = fabs(square.a);
    for (int j = 0; j < 2; ++j) size += fabs(b[j]);
    size += fabs(q[IMP_UU]) + fabs(q[IMP_UV]) + fabs(q[IMP_VV]);
    const double in_time = fabs(b[2]) + fabs(q[IMP_UT]) + fabs(q[IMP_VT]) + fabs(q[IMP_TT]);
    if (in_time != 0) return INFINITY; /* the type contradicts itself */
    if (!(size < 0x1p400)) return INFINITY;
    const quadratics p = {imp_quad_all(-b[0]), imp_quad_all(-b[1]), imp_quad_all(-q[IMP_UU]),
                          imp_quad_all(-q[IMP_UV]), imp_quad_all(-q[IMP_VV])};
    const double least = quadratics_lower(&p)[0];
    const double rounding = padded_upper(size, 16) * ((QUADRATIC_ROUNDING + 16) * UNIT_ROUNDOFF);
    const double most =
        sum_upper(sum_upper(square.a - least, square.e), 2 * rounding) + QUADRATIC_UNDERFLOW;
    const double greatest = most < square.hi ? most : square.hi;
    return greatest > 0 ? padded_upper(sqrt(greatest), 32) + ROOT_UNDERFLOW : ROOT_UNDERFLOW;
}

/* --- All cells -------------------------------------------------------------------------------- */

/* Pieces and cells that are looked at, and how often a cell is halved, at most. */
enum { PIECES_AT_MOST = 4096, CELLS_MOST = 8192, DEPTH = 40 };

typedef struct search {
    const spine *of;
    double goal;     /* radii up to this one will do */
    double farthest; /* a radius that some point has at least, about */
    size_t cells;
    reach all;
} search;

/* Along which parameter to halve a cell: that in which it bends most, or, where its models are
 * boxes, in which it extends most across the line. */
static int worst_of(const spine *of, const imp_model x[3], const imp_region *cell)
{
    double bend[2] = {0, 0}, extent[2] = {0, 0};
    for (int i = 0; i < 3; ++i) {
        const double across = 1 - of->axis[i] * of->axis[i];
        bend[0] += fabs(x[i].q[IMP_UU]);
        bend[1] += fabs(x[i].q[IMP_VV]);
        for (int j = 0; j < 2; ++j)
            extent[j] += across > 0 ? x[i].rate[j] * cell->d[j] * across : 0;
    }
    const double *const by = bend[0] + bend[1] > 0 ? bend : extent;
    return by[0] >= by[1] ? 0 : 1;
}

/* A radius that the point in the middle has at least, about. */
static double middle_radius(const spine *of, const imp_model x[3])
{
    const vec3 at = {{x[0].a, x[1].a, x[2].a}}, off = {{x[0].e, x[1].e, x[2].e}};
    return -vec3_norm(off) +
           vec3_norm(vec3_cross(vec3_sub(at, vec3_from(of->center)), vec3_from(of->axis)));
}

static void join(reach *all, const reach *one)
{
    if (one->radius > all->radius) all->radius = one->radius;
    if (one->lo < all->lo) all->lo = one->lo;
    if (one->hi > all->hi) all->hi = one->hi;
}

/* What is to be done with a cell; WHOLE: nothing more. */
typedef enum verdict { HALVE_U, HALVE_V, WHOLE, HOPELESS } verdict;

/* Looks at one cell, and joins what it shows if that will do. HOPELESS: it has no bounds, or a
 * point in it is too far away. */
static verdict look(search *s, const surface *piece, const imp_region *cell, imp_status *status)
{
    imp_model x[3];
    piece_cell corners;
    s->cells += 1;
    *status = surface_include_inner(piece, cell, s->of->inner, x);
    if (*status != IMP_STATUS_OK || !piece_cell_of(x, &corners)) return HOPELESS;
    reach r = reach_of_corners(s->of, &corners);
    const double by_square = radius_of_square(s->of, x);
    if (by_square < r.radius) r.radius = by_square;
    if (!(r.hi - r.lo < INFINITY)) return HOPELESS;
    const double here = middle_radius(s->of, x);
    if (here > s->farthest) s->farthest = here;
    if (here > s->goal) return HOPELESS;
    if (!(r.radius <= s->goal)) return worst_of(s->of, x, cell) == 0 ? HALVE_U : HALVE_V;
    join(&s->all, &r);
    return WHOLE;
}

/* Depth first; the second halves of cells wait on a stack. */
static bool search_piece(search *s, const surface *piece, const imp_region *all, imp_status *status)
{
    imp_region stack[DEPTH + 1];
    int depth[DEPTH + 1], count = 1;
    stack[0] = *all;
    depth[0] = 0;
    while (count > 0) {
        const imp_region cell = stack[--count];
        const int level = depth[count];
        const verdict found = look(s, piece, &cell, status);
        if (found == WHOLE) continue;
        if (found == HOPELESS || level == DEPTH || s->cells > CELLS_MOST) return false;
        const parameter j = found == HALVE_U ? PARAMETER_U : PARAMETER_V;
        if (!region_can_split(&cell, j)) return false;
        for (int half = 0; half < 2; ++half, ++count) {
            region_set_half(&stack[count], &cell, j, half);
            depth[count] = level + 1;
        }
    }
    return true;
}

/* How much cells may leave to what the type says, as a part of the radius. */
#define COARSE 0.0625

imp_code spine_measure(spine *of, const time_window *times, double goal, bool *known,
                       imp_error *error)
{
    const size_t parts = surface_part_count(of->of);
    const double coarse = of->is_of_type ? (1 + COARSE) * of->radius : 0;
    search s = {.of = of,
                .goal = coarse > goal ? coarse : goal,
                .farthest = of->radius,
                .all = {0, INFINITY, -INFINITY}};
    *known = false;
    if (parts > PIECES_AT_MOST) return IMP_SUCCESS;
    for (size_t k = 0; k < parts; ++k) {
        const surface *piece = surface_part(of->of, k);
        double lo[3], hi[3];
        imp_status status;
        surface_domain(piece, lo, hi);
        lo[2] = times->lo, hi[2] = times->hi;
        const imp_region all = region_make(lo, hi);
        if (search_piece(&s, piece, &all, &status)) continue;
        of->radius = s.farthest;
        return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED
                   ? IMP_SUCCESS
                   : distance_fault(piece, status, error);
    }
    of->radius = s.all.radius;
    of->from = s.all.lo;
    of->to = s.all.hi;
    const imp_code code = of->radius > goal ? spine_reduce(of, times, goal, error) : IMP_SUCCESS;
    *known = of->radius <= goal;
    return code;
}
