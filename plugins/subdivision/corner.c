/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/corner.h"

#include <impinge/interval.h>

/* --- Finding the points --------------------------------------------------------------------------- */

/* Where the corners of the quad are, and the neighbours beyond each side: those next to its beginning, to
 * its end, and beyond its end. */
static const int side_from[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const int side_out[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};

static uint32_t *grid_at(corner_points *to, const int from[2], const int out[2])
{
    return &to->grid[from[0] + out[0] + 1][from[1] + out[1] + 1];
}

/* The face beyond side k, half-edge h, and the one beyond that at the end of the side. Without a face
 * beyond a side, the points there are not there. */
static void find_beyond(const control_mesh *m, uint32_t h, int k, corner_points *to)
{
    const int *a = side_from[k], *b = side_from[(k + 1) % 4], *out = side_out[k];
    const uint32_t twin = m->twin[h];
    if (twin == CONTROL_NONE) return;
    *grid_at(to, a, out) = control_end(m, control_next(m, twin));
    const uint32_t back = control_previous(m, twin);
    *grid_at(to, b, out) = m->corner[back];
    if (m->twin[back] == CONTROL_NONE) return;
    const int far[2] = {b[0] + out[0], b[1] + out[1]};
    *grid_at(to, far, side_out[(k + 1) % 4]) = control_end(m, control_next(m, m->twin[back]));
}

static void find_fan(const control_mesh *m, uint32_t h, corner_points *to)
{
    uint32_t first = h, last = h;
    to->at = 0;
    for (uint32_t g = control_turn_right(m, h); g != CONTROL_NONE && g != h;
         g = control_turn_right(m, g))
        first = g, to->at += 1;
    const bool is_closed = control_turn_right(m, first) != CONTROL_NONE;
    if (is_closed) first = h, to->at = 0;
    to->faces = 0;
    for (uint32_t g = first; g != CONTROL_NONE && (to->faces == 0 || g != first);
         g = control_turn_left(m, g)) {
        to->edge[to->faces] = control_end(m, g);
        to->diagonal[to->faces++] = control_end(m, control_next(m, g));
        last = g;
    }
    to->edges = to->faces;
    if (!is_closed) to->edge[to->edges++] = m->corner[control_previous(m, last)];
    to->has_fan = is_closed ? to->faces != 4 : to->faces > 2;
}

void corner_find(const control_mesh *m, uint32_t h, corner_points *to)
{
    for (int x = 0; x < CORNER_SIDE; ++x)
        for (int y = 0; y < CORNER_SIDE; ++y) to->grid[x][y] = CONTROL_NONE;
    find_fan(m, h, to);
    for (int k = 0; k < 4; ++k, h = control_next(m, h)) {
        to->grid[side_from[k][0] + 1][side_from[k][1] + 1] = m->corner[h];
        find_beyond(m, h, k, to);
    }
}

/* --- Where the corner lies ---------------------------------------------------------------------------- */

/* The limit of one coordinate. With n faces, N = n (n + 5), all of
 *
 *   (n^2 c + 4 sum_k e_k + sum_k d_k) / N,   at a border (e_first + 4 c + e_last) / 6
 *
 * are written as c and a mean of differences to c. Lemma. Those, at most `most`, are rounded once, their
 * sum at most 2 n times, product and quotient 3; the last sum once. */
static double limit_of(const corner_points *of, const double *list, size_t axis, double *error)
{
    const double c = list[3 * (size_t)of->grid[1][1] + axis], n = of->faces;
    double sum = 0, most = 0, weight = n * (n + 5);
    for (int k = 0; k < of->edges; ++k) {
        const double e = list[3 * (size_t)of->edge[k] + axis] - c;
        if (of->edges == of->faces) {
            const double d = list[3 * (size_t)of->diagonal[k] + axis] - c;
            sum += 4 * e + d;
            most = imp_larger(most, fabs(d));
        } else if (k == 0 || k == of->faces) {
            sum += e, weight = 6;
        }
        most = imp_larger(most, fabs(e));
    }
    const double x = c + sum / weight;
    *error = ((2 * n + 8) * most + fabs(x)) * 0x1p-53 * (1 + 0x1p-40);
    return x;
}

void corner_limit(const corner_points *of, const control_mesh *m, corner_frame *limit,
                  corner_frame *error)
{
    memset(limit, 0, sizeof *limit);
    memset(error, 0, sizeof *error);
    for (size_t axis = 0; axis < 3; ++axis) {
        limit->place[axis] = limit_of(of, m->point, axis, &error->place[axis]);
        error->place[axis] += m->slip[axis];
        if (m->velocity == NULL) continue;
        limit->drift[axis] = limit_of(of, m->velocity, axis, &error->drift[axis]);
        error->drift[axis] += m->slip_motion[axis];
    }
}

/* --- Rows beyond a border ------------------------------------------------------------------------------ */

/* A row (x fixed) or column (y fixed) of the grid: twice the one at the border less the next. */
static void reflect_along(corner_net *n, int out, int inner, int next, bool is_row)
{
    for (int k = 0; k < CORNER_FINE; ++k)
        for (int g = 0; g < n->groups; ++g) {
            imp_quad *to = is_row ? &n->grid[out][k][g] : &n->grid[k][out][g];
            const imp_quad a = is_row ? n->grid[inner][k][g] : n->grid[k][inner][g];
            const imp_quad b = is_row ? n->grid[next][k][g] : n->grid[k][next][g];
            *to = 2 * a - b;
        }
}

/* Beyond the sides that are at a border; `last` is what lies beyond (1, 1). Columns first: the rows then
 * set their ends anew. */
static void reflect(corner_net *n, int last)
{
    if (n->is_border[0]) reflect_along(n, 0, 1, 2, false);
    if (n->is_border[2]) reflect_along(n, last, last - 1, last - 2, false);
    if (n->is_border[3]) reflect_along(n, 0, 1, 2, true);
    if (n->is_border[1]) reflect_along(n, last, last - 1, last - 2, true);
}

/* --- Taking points --------------------------------------------------------------------------------------- */

static void take_most(corner_net *n, int side)
{
    for (int g = 0; g < n->groups; ++g) {
        imp_quad most = imp_quad_abs(n->centre[g]);
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y)
                if (x + y > 0 || n->faces == 0) most = imp_quad_max(imp_quad_abs(n->grid[x][y][g]), most);
        for (int k = 0; k < n->edges; ++k) most = imp_quad_max(imp_quad_abs(n->edge[k][g]), most);
        for (int k = 0; k < n->faces; ++k) most = imp_quad_max(imp_quad_abs(n->diagonal[k][g]), most);
        imp_quad_store(n->most + g * IMP_QUAD, most);
    }
}

static void take_point(const control_mesh *m, const corner_frame *frame, uint32_t p, int groups,
                       imp_quad to[CORNER_GROUPS])
{
    const double *x = m->point + 3 * (size_t)p, *o = frame->place, *w = frame->drift;
    to[0] = imp_quad_of(x[0] - o[0], x[1] - o[1], x[2] - o[2], 0);
    if (groups == 1) return;
    const double *v = m->velocity + 3 * (size_t)p;
    to[1] = imp_quad_of(v[0] - w[0], v[1] - w[1], v[2] - w[2], 0);
}

/* A point less the place is rounded once, unless the place is 0. */
static void take_slip(const control_mesh *m, const corner_frame *frame, corner_net *n)
{
    memset(n->slip, 0, sizeof n->slip);
    for (int i = 0; i < 3; ++i) {
        n->slip[i] = m->slip[i] + (frame->place[i] != 0 ? 0x1p-53 * n->most[i] : 0);
        if (n->groups == 1) continue;
        const int lane = IMP_QUAD + i;
        n->slip[lane] = m->slip_motion[i] + (frame->drift[i] != 0 ? 0x1p-53 * n->most[lane] : 0);
    }
}

void corner_take(const corner_points *of, const control_mesh *m, const corner_frame *frame,
                 corner_net *to)
{
    to->groups = m->velocity != NULL ? 2 : 1;
    to->faces = of->has_fan ? of->faces : 0;
    to->edges = of->has_fan ? of->edges : 0;
    to->at = of->at;
    to->is_border[0] = of->grid[1][0] == CONTROL_NONE;
    to->is_border[1] = of->grid[3][1] == CONTROL_NONE;
    to->is_border[2] = of->grid[1][3] == CONTROL_NONE;
    to->is_border[3] = of->grid[0][1] == CONTROL_NONE;
    memset(to->grid, 0, sizeof to->grid);
    for (int x = 0; x < CORNER_SIDE; ++x)
        for (int y = 0; y < CORNER_SIDE; ++y)
            if (of->grid[x][y] != CONTROL_NONE)
                take_point(m, frame, of->grid[x][y], to->groups, to->grid[x][y]);
    memcpy(to->centre, to->grid[1][1], sizeof to->centre);
    for (int k = 0; k < to->edges; ++k) take_point(m, frame, of->edge[k], to->groups, to->edge[k]);
    for (int k = 0; k < to->faces; ++k)
        take_point(m, frame, of->diagonal[k], to->groups, to->diagonal[k]);
    reflect(to, CORNER_SIDE - 1);
    take_most(to, CORNER_SIDE);
    take_slip(m, frame, to);
}

/* --- One step ---------------------------------------------------------------------------------------------- */

/* Numbers at -1 to 2 become those at -1/2, 0, 1/2, 1, 3/2: cubic B-splines by halves. */
IMP_QUAD_INLINE void halve(const imp_quad in[CORNER_SIDE], imp_quad out[CORNER_FINE])
{
    for (int k = 0; k < 3; ++k) out[2 * k] = 0.5 * (in[k] + in[k + 1]);
    for (int k = 0; k < 2; ++k) out[2 * k + 1] = 0.125 * (in[k] + 6 * in[k + 1] + in[k + 2]);
}

static void halve_grid(const corner_net *from, int g, corner_net *to)
{
    imp_quad half[CORNER_SIDE][CORNER_FINE];
    for (int x = 0; x < CORNER_SIDE; ++x) {
        imp_quad in[CORNER_SIDE];
        for (int y = 0; y < CORNER_SIDE; ++y) in[y] = from->grid[x][y][g];
        halve(in, half[x]);
    }
    for (int y = 0; y < CORNER_FINE; ++y) {
        imp_quad in[CORNER_SIDE], out[CORNER_FINE];
        for (int x = 0; x < CORNER_SIDE; ++x) in[x] = half[x][y];
        halve(in, out);
        for (int x = 0; x < CORNER_FINE; ++x) to->grid[x][y][g] = out[x];
    }
}

/* The means of control_mesh.h, of the older points: with n faces all around, (1 - 7 / (4 n)) c +
 * 3 / (2 n^2) sum_k e_k + 1 / (4 n^2) sum_k d_k. */
static void step_fan(const corner_net *from, int g, corner_net *to)
{
    const int n = from->faces, edges = from->edges;
    const imp_quad c = from->centre[g];
    imp_quad sum_e = {0}, sum_d = {0};
    for (int k = 0; k < n; ++k) {
        const imp_quad ends = from->edge[k][g] + from->edge[(k + 1) % edges][g];
        to->diagonal[k][g] = 0.25 * (c + ends + from->diagonal[k][g]);
        sum_d += from->diagonal[k][g];
    }
    for (int k = 0; k < edges; ++k) {
        const imp_quad e = from->edge[k][g];
        if (edges == n || (k > 0 && k < n))
            to->edge[k][g] =
                0.25 * (c + e + to->diagonal[k % n][g] + to->diagonal[(k + n - 1) % n][g]);
        else
            to->edge[k][g] = 0.5 * (c + e);
        sum_e += e;
    }
    if (edges == n)
        to->centre[g] = (1 - 7.0 / (4 * n)) * c + 1.5 / (n * n) * sum_e + 0.25 / (n * n) * sum_d;
    else
        to->centre[g] = 0.125 * (from->edge[0][g] + 6 * c + from->edge[n][g]);
}

/* What the grid alone does not say: the points that the fan's closing decides. */
static void join_fan(corner_net *to)
{
    const int below = (to->at + to->edges - 1) % to->edges, left = (to->at + 2) % to->edges;
    for (int g = 0; g < to->groups; ++g) {
        to->grid[1][1][g] = to->centre[g];
        if (!to->is_border[0]) to->grid[1][0][g] = to->edge[below][g];
        if (!to->is_border[3]) to->grid[0][1][g] = to->edge[left][g];
    }
}

/* Lemma (slip). All points but those beyond a border are means of such points: with a row there put as
 * 2 p_0 - p_1, (p_-1 + 6 p_0 + p_1) / 8 is p_0 and (p_-1 + p_0) / 2 is not needed but for the new such
 * row, which is set anew. So what points are off does not grow, and a step adds its own roundings: 3 for
 * each direction of the grid; 4 and 8 of the fan's means; n + 5 of its centre's; and what the rows beyond a
 * border are off. */
void corner_step(const corner_net *from, corner_net *to)
{
    to->groups = from->groups, to->faces = from->faces;
    to->edges = from->edges, to->at = from->at;
    memcpy(to->is_border, from->is_border, sizeof to->is_border);
    for (int g = 0; g < from->groups; ++g) {
        halve_grid(from, g, to);
        step_fan(from, g, to);
    }
    join_fan(to);
    reflect(to, CORNER_FINE - 1);
    to->is_border[1] = to->is_border[2] = false;
    take_most(to, CORNER_FINE);
    for (int lane = 0; lane < from->groups * IMP_QUAD; ++lane)
        to->slip[lane] = (from->slip[lane] + ((from->faces + 12) * 0x1p-53 + CORNER_REFLECTION) *
                                                 from->most[lane]) *
                         (1 + 0x1p-40);
}
