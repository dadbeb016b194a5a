/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/course_line.h"

#include <math.h>

#include "core/surface/course.h"

double course_line_between(const rigid_numbers *m0, const rigid_numbers *m1, double center[3],
                           double axis[3])
{
    /* X = M1 M0^-1 takes x to turn x + d. */
    double turn[3][3], d[3], across[3], along = 0, size = 0, trace = 0;
    for (int i = 0; i < 3; ++i) {
        d[i] = m1->shift[i];
        for (int j = 0; j < 3; ++j) {
            turn[i][j] = 0;
            for (int k = 0; k < 3; ++k) turn[i][j] += m1->turn[i][k] * m0->turn[j][k];
            d[i] -= turn[i][j] * m0->shift[j];
        }
        trace += turn[i][i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        axis[i] = 0.5 * (turn[k][j] - turn[j][k]);
        size += axis[i] * axis[i];
    }
    const double sine = sqrt(size);
    if (!(sine > 0)) return 0;
    for (int i = 0; i < 3; ++i) axis[i] /= sine;
    for (int i = 0; i < 3; ++i) along += axis[i] * d[i];
    for (int i = 0; i < 3; ++i) across[i] = d[i] - along * axis[i];
    const double cotangent = (1 + 0.5 * (trace - 1)) / sine;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        center[i] = 0.5 * (across[i] + cotangent * (axis[j] * across[k] - axis[k] * across[j]));
    }
    return sine;
}

bool course_place_at(const surface *s, size_t inner, double t, rigid_numbers *place)
{
    double x[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    if (surface_move_outward(s, inner, t, 3, x[0]) != IMP_STATUS_OK) return false;
    for (int i = 0; i < 3; ++i) {
        place->shift[i] = x[0][i];
        for (int j = 0; j < 2; ++j) place->turn[i][j] = x[1 + j][i] - x[0][i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        place->turn[i][2] =
            place->turn[j][0] * place->turn[k][1] - place->turn[k][0] * place->turn[j][1];
    }
    return true;
}

static bool relate_places(const surface *a, const surface *b, double t, rigid_numbers *m)
{
    rigid_numbers of_a, of_b;
    if (!course_place_at(a, surface_inner_maps(a), t, &of_a) ||
        !course_place_at(b, surface_inner_maps(b), t, &of_b))
        return false;
    for (int i = 0; i < 3; ++i) {
        m->shift[i] = 0;
        for (int k = 0; k < 3; ++k)
            m->shift[i] += of_a.turn[k][i] * (of_b.shift[k] - of_a.shift[k]);
        for (int j = 0; j < 3; ++j) {
            m->turn[i][j] = 0;
            for (int k = 0; k < 3; ++k) m->turn[i][j] += of_a.turn[k][i] * of_b.turn[k][j];
        }
    }
    return true;
}

/* Whether the rotation from m0 to m1 keeps the axis, nearly. */
static bool keeps_axis(const rigid_numbers *m0, const rigid_numbers *m1, const double axis[3])
{
    double off[3];
    for (int i = 0; i < 3; ++i) {
        off[i] = -axis[i];
        for (int k = 0; k < 3; ++k) {
            double then = 0; /* M0^-1 of it */
            for (int j = 0; j < 3; ++j) then += m0->turn[j][k] * axis[j];
            off[i] += m1->turn[i][k] * then;
        }
        if (fabs(off[i]) > 0x1p-6) return false;
    }
    return true;
}

bool course_is_likely(const surface *a, const surface *b, const imp_region *times)
{
    static const double parts[3] = {0.5, 0.81, 0.23};
    rigid_numbers m[3];
    double center[2][3], axis[2][3], sine[2];
    for (int k = 0; k < 3; ++k) {
        const double t = (1 - parts[k]) * times->lo[2] + parts[k] * times->hi[2];
        if (!(times->lo[2] <= t && t <= times->hi[2])) return true;
        if (!relate_places(a, b, t, &m[k])) return true;
    }
    for (int k = 0; k < 2; ++k) sine[k] = course_line_between(&m[0], &m[1 + k], center[k], axis[k]);
    const int best = sine[1] > sine[0];
    if (!(sine[best] > SINE_LEAST)) return true;
    return keeps_axis(&m[0], &m[1 + !best], axis[best]);
}
