/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/prism.h"

#include <impinge/formula_text.h>
#include <string.h>

void prism_place(double to[3], const double at[2], const double *vector)
{
    to[0] = at[0] + (vector != NULL ? vector[0] : 0);
    to[1] = at[1] + (vector != NULL ? vector[1] : 0);
    to[2] = vector != NULL ? vector[2] : 0;
}

/* A side is p + u (q - p) + v vector, of these very numbers: q - p is rounded once, which linear.h
 * has room for, and so has facet_gap, whose flatness has 32 u, of which 7 were taken. So sides meet
 * in common edges. */
static void make_side(prism *s, const double p[2], const double q[2], const double vector[3])
{
    const double edge[3] = {q[0] - p[0], q[1] - p[1], 0};
    prism_place(s->corner[0], p, NULL);
    prism_place(s->corner[1], q, NULL);
    memcpy(s->corner[2], vector, sizeof s->corner[2]);
    facet_span(&s->face, s->corner[0], edge, vector);
}

/* An end is a triangle between p, q and the center r, at v = 0 of the lower end and v = 1 of the
 * upper. All of it has one z exactly, and so its normal is exact, and its flatness 0 (facet.c).
 * Corners of the upper end are rounded to doubles: its rim is where the sides end, but for that. */
static void make_end(prism *s, const double p[2], const double q[2], const double center[2],
                     const double *vector)
{
    const bool is_upper = vector != NULL;
    double(*f)[4] = s->face.surface.still;
    const double(*c)[3] = (const double(*)[3])s->corner;
    prism_place(s->corner[0], p, vector);
    prism_place(s->corner[1], q, vector);
    prism_place(s->corner[2], center, vector);
    for (int i = 0; i < 3; ++i) {
        const double edge = c[1][i] - c[0][i];
        f[LINEAR_1][i] = c[is_upper ? 0 : 2][i];
        f[LINEAR_U][i] = is_upper ? edge : 0;
        f[LINEAR_V][i] = is_upper ? c[2][i] - c[0][i] : c[0][i] - c[2][i];
        f[LINEAR_UV][i] = is_upper ? -edge : edge;
    }
    s->face.normal[2] = is_upper ? 1 : -1;
    linear_finish(&s->face.surface);
}

void prism_make(prism *s, int part, const double p[2], const double q[2], const double center[2],
                const double vector[3])
{
    memset(s, 0, sizeof *s);
    s->part = part;
    if (part == PRISM_SIDE)
        make_side(s, p, q, vector);
    else
        make_end(s, p, q, center, part == PRISM_UPPER ? vector : NULL);
}

static const char *const formula[PRISM_PARTS] = {
    [PRISM_SIDE] = "(1 - u)*p0 + u*q0 + v*r0; (1 - u)*p1 + u*q1 + v*r1; v*r2",
    [PRISM_LOWER] = "(1 - v)*r0 + v*((1 - u)*p0 + u*q0); (1 - v)*r1 + v*((1 - u)*p1 + u*q1); r2",
    [PRISM_UPPER] = "(1 - v)*((1 - u)*p0 + u*q0) + v*r0; (1 - v)*((1 - u)*p1 + u*q1) + v*r1; r2",
};

void prism_write(const prism *s, const imp_text_sink *to)
{
    for (size_t i = 0; i < 2; ++i) imp_define_at(to, "p", i, s->corner[0][i]);
    for (size_t i = 0; i < 2; ++i) imp_define_at(to, "q", i, s->corner[1][i]);
    for (size_t i = 0; i < 3; ++i) imp_define_at(to, "r", i, s->corner[2][i]);
    imp_add_text(to, "u in [0, 1]; v in [0, 1]; ");
    imp_add_text(to, formula[s->part]);
}
