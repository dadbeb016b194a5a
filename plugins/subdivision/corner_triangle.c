/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/corner_build.h"

/* Neighbours on the grid, counterclockwise; and the corners of the triangle with the first of its
 * sides that begins there. */
enum { DIRECTIONS = 6 };
static const int direction[DIRECTIONS][2] = {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
static const int corner_at[3][2] = {{0, 0}, {1, 0}, {0, 1}};
static const int side_along[3] = {0, 2, 4};

static int turned(int d) { return (d + DIRECTIONS) % DIRECTIONS; }

/* --- Finding the points ----------------------------------------------------------------------- */

/* All around corner k, where half-edge h begins; it is regular. */
static void find_ring(const control_mesh *m, uint32_t h, int k, corner_points *to)
{
    unsigned known = 0;
    int d = side_along[k];
    uint32_t end[DIRECTIONS], g = h;
    do {
        end[turned(d)] = control_end(m, g), known |= 1u << turned(d);
        const uint32_t left = control_turn_left(m, g);
        d += 1;
        if (left == CONTROL_NONE)
            end[turned(d)] = m->corner[control_previous(m, g)], known |= 1u << turned(d);
        g = left;
    } while (g != CONTROL_NONE && g != h);
    g = g == h ? CONTROL_NONE : control_turn_right(m, h);
    for (d = side_along[k] - 1; g != CONTROL_NONE; --d, g = control_turn_right(m, g))
        end[turned(d)] = control_end(m, g), known |= 1u << turned(d);
    to->missing[k] = ~known & ((1u << DIRECTIONS) - 1);
    for (d = 0; d < DIRECTIONS; ++d)
        if (known >> d & 1)
            to->grid[corner_at[k][0] + direction[d][0] + 1][corner_at[k][1] + direction[d][1] + 1] =
                end[d];
}

void triangle_find(const control_mesh *m, uint32_t h, corner_points *to)
{
    for (int k = 0; k < 3; ++k, h = control_next(m, h)) {
        to->grid[corner_at[k][0] + 1][corner_at[k][1] + 1] = m->corner[h];
        to->is_border[k] = m->twin[h] == CONTROL_NONE;
        if (k > 0 || !to->has_fan) find_ring(m, h, k, to);
    }
}

/* --- Points beyond a border ------------------------------------------------------------------- */

static imp_quad *neighbour(corner_net *n, const int at[2], int d, int g)
{
    const int *out = direction[turned(d)];
    return &n->grid[at[0] + out[0] + 1][at[1] + out[1] + 1][g];
}

/* Two or four neighbours in a row, half of them from each side: p + q - r, where r p and r q are
 * the sides of a triangle and p q is beyond it. */
static void reflect_ring(corner_net *n, const int at[2], unsigned missing)
{
    if (missing == 0) return;
    int first = 0, count = 0;
    for (int d = 0; d < DIRECTIONS; ++d) {
        if (!(missing >> d & 1)) continue;
        count += 1;
        if (!(missing >> turned(d - 1) & 1)) first = d;
    }
    for (int g = 0; g < n->groups; ++g) {
        const imp_quad own = n->grid[at[0] + 1][at[1] + 1][g];
        for (int k = 0; k < count / 2; ++k) {
            const int left = first + k, right = first + count - 1 - k;
            *neighbour(n, at, left, g) =
                own + *neighbour(n, at, left - 1, g) - *neighbour(n, at, left - 2, g);
            *neighbour(n, at, right, g) =
                own + *neighbour(n, at, right + 1, g) - *neighbour(n, at, right + 2, g);
        }
    }
}

/* A corner P_k of the triangle, or what a step makes of it, at twice its place: its neighbours in
 * the same directions are missing. */
void triangle_reflect(corner_net *n, int side)
{
    const int scale = side == CORNER_FINE ? 2 : 1;
    for (int k = n->faces > 0; k < 3; ++k)
        reflect_ring(n, (const int[2]){scale * corner_at[k][0], scale * corner_at[k][1]},
                     n->missing[k]);
}

/* --- One step --------------------------------------------------------------------------------- */

static imp_quad at_grid(const corner_net *n, int x, int y, int g)
{
    return n->grid[x + 1][y + 1][g];
}

/* The middle of an edge from (x, y) in direction d. */
static imp_quad edge_point(const corner_net *n, int x, int y, int d, int g)
{
    const int *out = direction[d], *left = direction[turned(d + 1)],
              *right = direction[turned(d - 1)];
    return 0.375 * (at_grid(n, x, y, g) + at_grid(n, x + out[0], y + out[1], g)) +
           0.125 * (at_grid(n, x + left[0], y + left[1], g) +
                    at_grid(n, x + right[0], y + right[1], g));
}

static imp_quad corner_point(const corner_net *n, int x, int y, int g)
{
    imp_quad around = {0};
    for (int d = 0; d < DIRECTIONS; ++d)
        around += at_grid(n, x + direction[d][0], y + direction[d][1], g);
    return 0.625 * at_grid(n, x, y, g) + 0.0625 * around;
}

/* Point (x, y) of the finer grid. */
static imp_quad fine_point(const corner_net *n, int x, int y, int g)
{
    const bool odd_x = x % 2 != 0, odd_y = y % 2 != 0;
    if (odd_x && odd_y) return edge_point(n, (x + 1) / 2, (y - 1) / 2, 2, g);
    if (odd_x) return edge_point(n, (x - 1) / 2, y / 2, 0, g);
    if (odd_y) return edge_point(n, x / 2, (y - 1) / 2, 1, g);
    return corner_point(n, x / 2, y / 2, g);
}

/* All that the children but the first depend on; that of the first around its corner is the
 * fan's. */
static void halve_grid(const corner_net *from, int g, corner_net *to)
{
    for (int x = -1; x <= 3; ++x)
        for (int y = -1; y <= 3; ++y) {
            const bool is_needed = x + y >= 1 && x + y <= 3;
            to->grid[x + 1][y + 1][g] = is_needed ? fine_point(from, x, y, g) : (imp_quad){0};
        }
}

static void step_fan(const corner_net *from, int g, corner_net *to)
{
    const int n = from->faces, edges = from->edges;
    const imp_quad c = from->centre[g];
    imp_quad sum = {0};
    for (int k = 0; k < edges; ++k) {
        const imp_quad e = from->edge[k][g];
        sum += e;
        if (edges == n || (k > 0 && k < n))
            to->edge[k][g] = 0.375 * (c + e) + 0.125 * (from->edge[(k + 1) % edges][g] +
                                                        from->edge[(k + edges - 1) % edges][g]);
        else
            to->edge[k][g] = 0.5 * (c + e);
    }
    if (edges == n)
        to->centre[g] = c + control_loop_share(n) * (sum / n - c);
    else
        to->centre[g] = 0.125 * (from->edge[0][g] + 6 * c + from->edge[n][g]);
}

/* The corner and its neighbours at (1,-1) and (-1,1), where a border may be. */
static void join_fan(corner_net *to)
{
    const int below = (to->at + to->edges - 1) % to->edges, left = (to->at + 2) % to->edges;
    for (int g = 0; g < to->groups; ++g) {
        const imp_quad c = to->centre[g], b = at_grid(to, 1, 0, g), d = at_grid(to, 0, 1, g);
        to->grid[1][1][g] = c;
        const imp_quad beyond_b = c + b - d, beyond_d = c + d - b;
        to->grid[2][0][g] = to->is_border[0] ? beyond_b : to->edge[below][g];
        to->grid[0][2][g] = to->is_border[2] ? beyond_d : to->edge[left][g];
    }
}

/* Lemma (slip). All points but those beyond a border are means of such points: with p + q - r
 * beyond an edge p q the masks of the inside give those of the border. So what points are off does
 * not grow, and a step adds less than n + CORNER_STEP_UNITS units of 2^-53 `most` and
 * CORNER_REFLECTION: the corner's mean n + 7, and 16 for its share (control_smooth.c); another
 * corner's 9, an edge's 5, and a quarter at most of what points beyond a border are off. */
void triangle_step(const corner_net *from, corner_net *to)
{
    for (int g = 0; g < from->groups; ++g) {
        halve_grid(from, g, to);
        step_fan(from, g, to);
    }
    join_fan(to);
    triangle_reflect(to, CORNER_FINE);
    to->is_border[1] = false;
    to->missing[1] = to->is_border[0] ? 1u << 4 | 1u << 5 : 0;
    to->missing[2] = to->is_border[2] ? 1u << 2 | 1u << 3 : 0;
}
