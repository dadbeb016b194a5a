/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/nearest.h"

#include "tests/support/shape_oracle.h"

typedef void point_of(const type_arguments *arguments, double u, double v, double x[3]);

void nearest_thread_point(const type_arguments *arguments, double u, double v, double x[3])
{
    const imp_value *profile = argument(arguments, "profile");
    const double turns = v / argument(arguments, "pitch")->number[0];
    const double phase = argument(arguments, "starts")->number[0] * u - 6.283185307179586 * turns;
    double radius = argument(arguments, "radius")->number[0];
    for (size_t k = 0; k < profile->count; ++k)
        radius += profile->number[k] * cos((double)(k + 1) * phase);
    x[0] = radius * cos(u), x[1] = radius * sin(u), x[2] = v;
}

void nearest_ellipsoid_point(const type_arguments *arguments, double u, double v, double x[3])
{
    const double *radii = argument(arguments, "radii")->number;
    x[0] = radii[0] * cos(v) * cos(u);
    x[1] = radii[1] * cos(v) * sin(u);
    x[2] = radii[2] * sin(v);
}

typedef struct spot {
    double u, v, square; /* square: of its distance */
} spot;

static spot spot_at(const type_arguments *arguments, point_of *point, const double to[3], double u,
                    double v)
{
    spot p = {u, v, 0};
    double x[3];
    point(arguments, u, v, x);
    for (int i = 0; i < 3; ++i) p.square += (x[i] - to[i]) * (x[i] - to[i]);
    return p;
}

/* The nearest of a grid with `steps` steps of these sizes to each side, or the middle. */
static spot step_nearer(const type_arguments *arguments, point_of *point, const double to[3],
                        int steps, double du, double dv, spot middle)
{
    spot best = middle;
    for (int j = -steps; j <= steps; ++j) {
        for (int k = -steps; k <= steps; ++k) {
            const spot p = spot_at(arguments, point, to, middle.u + j * du, middle.v + k * dv);
            if (p.square < best.square) best = p;
        }
    }
    return best;
}

/* From (u, v) on. */
static spot search(const type_arguments *arguments, point_of *point, const double to[3], double u,
                   double v, double du, double dv)
{
    spot p = spot_at(arguments, point, to, u, v);
    p = step_nearer(arguments, point, to, 6, du, dv, p);
    for (int k = 0; k < 36; ++k, du *= 0.6, dv *= 0.6)
        p = step_nearer(arguments, point, to, 2, 0.6 * du, 0.6 * dv, p);
    return p;
}

static void from_center(const type_arguments *arguments, const number x[3], double to[3])
{
    for (size_t i = 0; i < 3; ++i)
        to[i] = num_near(num_sub(x[i], argument_at(arguments, "center", i)));
}

static number distance(surface_oracle *surface, const type_arguments *arguments, const number x[3],
                       number u, number v)
{
    const number p[3] = {u, v, num(0)};
    number y[3];
    surface(arguments, p, y);
    return num_hypot(num_hypot(num_sub(x[0], y[0]), num_sub(x[1], y[1])), num_sub(x[2], y[2]));
}

number nearest_of_thread(const type_arguments *arguments, const number x[3])
{
    double to[3];
    from_center(arguments, x, to);
    const double du = 0.7 / argument(arguments, "starts")->number[0];
    const double dv = 0.2 * fabs(argument(arguments, "pitch")->number[0]);
    const spot p = search(arguments, nearest_thread_point, to, atan2(to[1], to[0]), to[2], du, dv);
    const number part = num_div(num(p.v), argument_at(arguments, "height", 0));
    return distance(thread_oracle, arguments, x, num(p.u), part);
}

number nearest_of_ellipsoid(const type_arguments *arguments, const number x[3])
{
    const double *radii = argument(arguments, "radii")->number;
    double to[3];
    from_center(arguments, x, to);
    const double u = atan2(to[1] / radii[1], to[0] / radii[0]);
    const double v = atan2(to[2] / radii[2], hypot(to[0] / radii[0], to[1] / radii[1]));
    const spot p = search(arguments, nearest_ellipsoid_point, to, u, v, 0.5, 0.5);
    return distance(ellipsoid_oracle, arguments, x, num(p.u), num(p.v));
}
