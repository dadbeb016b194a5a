/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/meridian.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void meridian_measure(const centre *about, const kept *of, meridian *m)
{
    const aim distance = {.n = {1, 0, 0}, .about = about},
              height = {.n = {0, 1, 0}, .about = about};
    jet parts[CENTRE_PARTS];
    centre_parts(of->centre, about, parts);
    const jet at[2] = {centre_distance(parts, &distance), centre_distance(parts, &height)};
    for (int i = 0; i < 2; ++i) {
        m->at[i] = ld_interval_mid(at[i].v);
        for (int j = 0; j < VARIABLES; ++j) {
            const double half = 0.5 * (of->where.hi[j] - of->where.lo[j]);
            m->way[j][i] = jet_has(&at[i], j) ? ld_interval_mid(at[i].d[j]) * half : 0;
        }
    }
    double u[3], v[3], n[3], out[3];
    const double length = sqrt(dot(about->d, about->d));
    for (int i = 0; i < 3; ++i) {
        u[i] = ld_interval_mid(of->centre[i].d[U]), v[i] = ld_interval_mid(of->centre[i].d[V]);
        out[i] = ld_interval_mid(of->centre[i].v) - about->c[i];
    }
    const double along = dot(out, about->d) / (length * length);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = u[j] * v[k] - u[k] * v[j];
        out[i] -= along * about->d[i];
    }
    const double size = sqrt(dot(n, n));
    m->normal[0] = dot(n, out) / (size * sqrt(dot(out, out)));
    m->normal[1] = dot(n, about->d) / (size * length);
}

/* What weights n leave between the sides beyond `apart`, about, for a unit of |n|. They are turned
 * from A to B. NAN: they are no weights. */
static double left_between(const meridian side[2], double apart, double n[2])
{
    const double length = hypot(n[0], n[1]);
    double gap = 0, spread = 0, drift = 0;
    for (int i = 0; i < 2; ++i) gap += n[i] * (side[1].at[i] - side[0].at[i]);
    for (int k = 0; k < 2 * T; ++k) {
        const double *way = side[k / T].way[k % T];
        spread += fabs(n[0] * way[0] + n[1] * way[1]);
    }
    for (int i = 0; i < 2; ++i) drift += n[i] * (side[1].way[T][i] - side[0].way[T][i]);
    spread += fabs(drift);
    for (int i = 0; i < 2; ++i) n[i] = (gap < 0 ? -n[i] : n[i]) / length;
    return (fabs(gap) - spread) / length - apart;
}

/* Whether the normal lies in the half plane, as all do where a surface is round about the line.
 * Normals of a thread meet it at an angle. */
static bool is_turned(const meridian *m)
{
    return m->normal[0] * m->normal[0] + m->normal[1] * m->normal[1] > 1 - 1e-9;
}

void meridian_choose(const meridian side[2], double apart, double n[2])
{
    double tried[4][2] = {{1, 0},
                          {side[0].normal[0], side[0].normal[1]},
                          {side[1].normal[0], side[1].normal[1]},
                          {side[1].at[0] - side[0].at[0], side[1].at[1] - side[0].at[1]}};
    double most = left_between(side, apart, tried[0]);
    memcpy(n, tried[0], sizeof tried[0]);
    if (!(most <= 0) || !is_turned(&side[0]) || !is_turned(&side[1])) return;
    for (int k = 1; k < 4; ++k) {
        const double left = left_between(side, apart, tried[k]);
        if (!(left > 0 && left > most)) continue;
        most = left;
        memcpy(n, tried[k], sizeof tried[k]);
    }
}
