/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/motions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void draw_axis(uint64_t *random, const imp_symmetry *of, long double n[3])
{
    long double square = 0, most = 0;
    for (int i = 0; i < 3; ++i) {
        n[i] = of->kind == IMP_SYMMETRY_ABOUT_POINT ? random_between(random, 0.1, 1) : of->axis[i];
        most = fmaxl(most, fabsl(n[i]));
    }
    for (int i = 0; i < 3; ++i) square += (n[i] / most) * (n[i] / most);
    for (int i = 0; i < 3; ++i) n[i] /= most * sqrtl(square);
}

/* Some turns, or up to IMP_SCREW_TURNS of them, which show a lead that is wrong by little. */
static motion draw_screw(uint64_t *random, const imp_symmetry *of)
{
    const long double turn = 2 * acosl(-1);
    const double turns =
        random_power(random, -4, 10) * (random_between(random, -1, 1) < 0 ? -1 : 1);
    const double hand = of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    long double n[3];
    motion m = {.angle = (double)(hand * turns * turn)};
    draw_axis(random, of, n);
    for (int i = 0; i < 3; ++i) {
        m.center[i] = of->center[i];
        m.axis[i] = (double)n[i];
        m.shift[i] = (double)(hand * m.angle / turn * of->axis[i]);
    }
    return m;
}

motion motion_draw(uint64_t *random, const imp_symmetry *of, double size)
{
    long double n[3], way[3], along = 0;
    if (of->kind == IMP_SYMMETRY_SCREW_RIGHT || of->kind == IMP_SYMMETRY_SCREW_LEFT)
        return draw_screw(random, of);
    motion m = {.angle = random_between(random, -4, 4)};
    const double far = size * random_power(random, -8, 20);
    draw_axis(random, of, n);
    for (int i = 0; i < 3; ++i) {
        way[i] = random_between(random, -1, 1);
        along += n[i] * way[i];
    }
    for (int i = 0; i < 3; ++i) {
        m.center[i] = of->center[i];
        m.axis[i] = (double)n[i];
        if (of->kind == IMP_SYMMETRY_ALONG_LINE) m.shift[i] = (double)(far * along * n[i]);
        if (of->kind == IMP_SYMMETRY_ACROSS_LINE)
            m.shift[i] = (double)(far * (way[i] - along * n[i]));
    }
    return m;
}

/* Rodrigues' formula. The axis is a unit vector but for 2^-52; the image follows within 2^-50 of x
 * - center. */
void motion_apply(const motion *m, double x[3])
{
    long double w[3], along = 0;
    const long double c = cosl(m->angle), s = sinl(m->angle);
    for (int i = 0; i < 3; ++i) {
        w[i] = (long double)x[i] - m->center[i];
        along += m->axis[i] * w[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const long double turned =
            c * w[i] + s * (m->axis[j] * w[k] - m->axis[k] * w[j]) + (1 - c) * along * m->axis[i];
        x[i] = (double)(m->center[i] + turned + m->shift[i]);
    }
}

subject_text motion_text(const motion *m)
{
    subject_text t;
    snprintf(
        t.text, sizeof t.text,
        "turning by %.6g rad about the line through (%.9g, %.9g, %.9g) along (%.9g, %.9g, %.9g), "
        "then moving by (%.9g, %.9g, %.9g)",
        m->angle, m->center[0], m->center[1], m->center[2], m->axis[0], m->axis[1], m->axis[2],
        m->shift[0], m->shift[1], m->shift[2]);
    return t;
}
