/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/corner_build.h"

#include <impinge/interval.h>

/* --- Finding the points ----------------------------------------------------------------------- */

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
    to->has_fan = !corner_is_regular(m, &(control_point){h, (uint16_t)to->faces, !is_closed});
}

void corner_find(const control_mesh *m, uint32_t h, corner_points *to)
{
    for (int x = 0; x < CORNER_SIDE; ++x)
        for (int y = 0; y < CORNER_SIDE; ++y) to->grid[x][y] = CONTROL_NONE;
    memset(to->missing, 0, sizeof to->missing);
    memset(to->is_border, 0, sizeof to->is_border);
    to->is_loop = m->loop != NULL;
    find_fan(m, h, to);
    if (to->is_loop)
        triangle_find(m, h, to);
    else
        quad_find(m, h, to);
}

/* --- Where the corner lies -------------------------------------------------------------------- */

/* The limit of one coordinate. With n faces, N = n (n + 5), all of
 *
 *   (n^2 c + 4 sum_k e_k + sum_k d_k) / N,   at a border (e_first + 4 c + e_last) / 6
 *   of Loop's c + sum_k (e_k - c) / N,   N = n + 3 n / (8 share)
 *
 * are written as c and a mean of differences to c. Lemma. Those, at most `most`, are rounded once,
 * their sum at most 2 n times, product and quotient 3; the last sum once. The share, from 0.23 to
 * 0.61, is off by 2^-50; n / N = 1 / (1 + 3 / (8 share)) has the derivative 3/8 / (share + 3/8)^2
 * <= 1.03 by it, which makes 9 units, and N has 4 roundings. */
static double limit_of(const corner_points *of, const double *list, size_t axis, double *error)
{
    const double c = list[3 * (size_t)of->grid[1][1] + axis], n = of->faces;
    double sum = 0, most = 0;
    double weight = of->is_loop ? n + 3 * n / (8 * control_loop_share(of->faces)) : n * (n + 5);
    for (int k = 0; k < of->edges; ++k) {
        const double e = list[3 * (size_t)of->edge[k] + axis] - c;
        if (of->edges == of->faces) {
            const double d = of->is_loop ? 0 : list[3 * (size_t)of->diagonal[k] + axis] - c;
            sum += of->is_loop ? e : 4 * e + d;
            most = imp_larger(most, fabs(d));
        } else if (k == 0 || k == of->faces) {
            sum += e, weight = 6;
        }
        most = imp_larger(most, fabs(e));
    }
    const double x = c + sum / weight;
    *error = ((2 * n + 8 + (of->is_loop ? 13 : 0)) * most + fabs(x)) * 0x1p-53 * (1 + 0x1p-40);
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

/* --- Taking points ---------------------------------------------------------------------------- */

static void take_most(corner_net *n, int side)
{
    for (int g = 0; g < n->groups; ++g) {
        imp_quad most = imp_quad_abs(n->centre[g]);
        for (int x = 0; x < side; ++x)
            for (int y = 0; y < side; ++y)
                if (x + y > 0 || n->faces == 0)
                    most = imp_quad_max(imp_quad_abs(n->grid[x][y][g]), most);
        for (int k = 0; k < n->edges; ++k) most = imp_quad_max(imp_quad_abs(n->edge[k][g]), most);
        for (int k = 0; k < n->faces && !n->is_loop; ++k)
            most = imp_quad_max(imp_quad_abs(n->diagonal[k][g]), most);
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
    to->is_loop = of->is_loop;
    memcpy(to->is_border, of->is_border, sizeof to->is_border);
    memcpy(to->missing, of->missing, sizeof to->missing);
    memset(to->grid, 0, sizeof to->grid);
    for (int x = 0; x < CORNER_SIDE; ++x)
        for (int y = 0; y < CORNER_SIDE; ++y)
            if (of->grid[x][y] != CONTROL_NONE)
                take_point(m, frame, of->grid[x][y], to->groups, to->grid[x][y]);
    memcpy(to->centre, to->grid[1][1], sizeof to->centre);
    for (int k = 0; k < to->edges; ++k) take_point(m, frame, of->edge[k], to->groups, to->edge[k]);
    for (int k = 0; k < to->faces && !to->is_loop; ++k)
        take_point(m, frame, of->diagonal[k], to->groups, to->diagonal[k]);
    if (to->is_loop)
        triangle_reflect(to, CORNER_SIDE);
    else
        quad_reflect(to, CORNER_SIDE);
    take_most(to, CORNER_SIDE);
    take_slip(m, frame, to);
}

/* --- One step --------------------------------------------------------------------------------- */

void corner_step(const corner_net *from, corner_net *to)
{
    to->groups = from->groups, to->faces = from->faces;
    to->edges = from->edges, to->at = from->at;
    to->is_loop = from->is_loop;
    memcpy(to->is_border, from->is_border, sizeof to->is_border);
    memcpy(to->missing, from->missing, sizeof to->missing);
    if (from->is_loop)
        triangle_step(from, to);
    else
        quad_step(from, to);
    take_most(to, CORNER_FINE);
    for (int lane = 0; lane < from->groups * IMP_QUAD; ++lane)
        to->slip[lane] =
            (from->slip[lane] +
             ((from->faces + CORNER_STEP_UNITS) * 0x1p-53 + CORNER_REFLECTION) * from->most[lane]) *
            (1 + 0x1p-40);
}
