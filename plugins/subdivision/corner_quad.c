/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/corner_build.h"

/* --- Finding the points ----------------------------------------------------------------------- */

/* Where the corners of the quad are, and the neighbours beyond each side: those next to its
 * beginning, to its end, and beyond its end. */
static const int side_from[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const int side_out[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};

static uint32_t *grid_at(corner_points *to, const int from[2], const int out[2])
{
    return &to->grid[from[0] + out[0] + 1][from[1] + out[1] + 1];
}

/* The face beyond side k, half-edge h, and the one beyond that at the end of the side. Without a
 * face beyond a side, the points there are not there. */
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

void quad_find(const control_mesh *m, uint32_t h, corner_points *to)
{
    for (int k = 0; k < 4; ++k, h = control_next(m, h)) {
        to->grid[side_from[k][0] + 1][side_from[k][1] + 1] = m->corner[h];
        to->is_border[k] = m->twin[h] == CONTROL_NONE;
        find_beyond(m, h, k, to);
    }
}

/* --- Rows beyond a border --------------------------------------------------------------------- */

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

/* Beyond the sides that are at a border. Columns first: the rows then set their ends anew. */
void quad_reflect(corner_net *n, int side)
{
    const int last = side - 1;
    if (n->is_border[0]) reflect_along(n, 0, 1, 2, false);
    if (n->is_border[2]) reflect_along(n, last, last - 1, last - 2, false);
    if (n->is_border[3]) reflect_along(n, 0, 1, 2, true);
    if (n->is_border[1]) reflect_along(n, last, last - 1, last - 2, true);
}

/* --- One step --------------------------------------------------------------------------------- */

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

/* Lemma (slip). All points but those beyond a border are means of such points: with a row there put
 * as 2 p_0 - p_1, (p_-1 + 6 p_0 + p_1) / 8 is p_0 and (p_-1 + p_0) / 2 is not needed but for the
 * new such row, which is set anew. So what points are off does not grow, and a step adds its own
 * roundings: 3 for each direction of the grid; 4 and 8 of the fan's means; n + 5 of its centre's;
 * and what the rows beyond a border are off: less than n + CORNER_STEP_UNITS and
 * CORNER_REFLECTION. */
void quad_step(const corner_net *from, corner_net *to)
{
    for (int g = 0; g < from->groups; ++g) {
        halve_grid(from, g, to);
        step_fan(from, g, to);
    }
    join_fan(to);
    quad_reflect(to, CORNER_FINE);
    to->is_border[1] = to->is_border[2] = false;
}
