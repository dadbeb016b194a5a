/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/face.h"

#include <impinge/formula_text.h>

/* A regular quad of the given mesh as a formula: a bicubic B-spline whose 4 by 4 control points are
 * P0, P1, P2 for x, y, z of point (0,0), P3 ... for (0,1). Points of finer meshes are rounded, and
 * what surrounds an extraordinary corner has no end: these say nothing. */

static size_t number_of(int i, int j, size_t axis)
{
    return 3 * (size_t)(CORNER_SIDE * i + j) + axis;
}

static void add_name(const imp_text_sink *to, int i, int j, size_t axis, const char *after)
{
    imp_add_text(to, "P");
    imp_add_whole(to, number_of(i, j, axis));
    imp_add_text(to, after);
}

static void define_point(const control_mesh *m, uint32_t point, int i, int j,
                         const imp_text_sink *to)
{
    for (size_t axis = 0; axis < 3; ++axis) {
        add_name(to, i, j, axis, " = ");
        imp_add_number(to, m->point[3 * (size_t)point + axis]);
        if (m->velocity != NULL) {
            imp_add_text(to, " + t*");
            imp_add_number(to, m->velocity[3 * (size_t)point + axis]);
        }
        imp_add_text(to, "; ");
    }
}

/* A point beyond a border: twice the one at the border less the next. */
static void define_beyond(int i, int j, int up_i, int up_j, const imp_text_sink *to)
{
    for (size_t axis = 0; axis < 3; ++axis) {
        add_name(to, i, j, axis, " = 2*");
        add_name(to, i + up_i, j + up_j, axis, " - ");
        add_name(to, i + 2 * up_i, j + 2 * up_j, axis, "; ");
    }
}

/* Rows beyond a border come from those inside, and at a corner of the border from the columns that
 * are beyond the other side, as quad_reflect has them. */
static void define_points(const control_mesh *m, const corner_points *p, const imp_text_sink *to)
{
    const bool *border = p->is_border;
    for (int i = border[3]; i < CORNER_SIDE - border[1]; ++i) {
        for (int j = border[0]; j < CORNER_SIDE - border[2]; ++j)
            define_point(m, p->grid[i][j], i, j, to);
        if (border[0]) define_beyond(i, 0, 0, 1, to);
        if (border[2]) define_beyond(i, CORNER_SIDE - 1, 0, -1, to);
    }
    for (int j = 0; j < CORNER_SIDE; ++j) {
        if (border[3]) define_beyond(0, j, 1, 0, to);
        if (border[1]) define_beyond(CORNER_SIDE - 1, j, -1, 0, to);
    }
}

static void add_sum(size_t axis, const imp_text_sink *to)
{
    static const char *const along_u[CORNER_SIDE] = {"a0*(", " + a1*(", " + a2*(", " + a3*("};
    static const char *const along_v[CORNER_SIDE] = {"b0*", " + b1*", " + b2*", " + b3*"};
    for (int i = 0; i < CORNER_SIDE; ++i) {
        imp_add_text(to, along_u[i]);
        for (int j = 0; j < CORNER_SIDE; ++j) {
            imp_add_text(to, along_v[j]);
            add_name(to, i, j, axis, "");
        }
        imp_add_text(to, ")");
    }
}

imp_status face_write(const face *q, const imp_text_sink *to)
{
    const control_mesh *m = q->mesh;
    corner_points p;
    bool is_exact = q->gauge == NULL && m->loop == NULL;
    for (int i = 0; i < 3; ++i) is_exact = is_exact && m->slip[i] == 0 && m->slip_motion[i] == 0;
    if (!is_exact) return IMP_STATUS_UNBOUNDED;
    corner_find(m, q->start, &p);
    define_points(m, &p, to);
    imp_add_text(to, "a0 = (1 - u)^3/6; a1 = (3*u^3 - 6*u^2 + 4)/6; "
                     "a2 = (3*u + 3*u^2 - 3*u^3 + 1)/6; a3 = u^3/6; "
                     "b0 = (1 - v)^3/6; b1 = (3*v^3 - 6*v^2 + 4)/6; "
                     "b2 = (3*v + 3*v^2 - 3*v^3 + 1)/6; b3 = v^3/6; u in [0, 1]; v in [0, 1]; ");
    for (size_t axis = 0; axis < 3; ++axis) {
        add_sum(axis, to);
        if (axis < 2) imp_add_text(to, "; ");
    }
    return IMP_STATUS_OK;
}
