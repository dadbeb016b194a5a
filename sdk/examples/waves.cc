/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type of a lambda, in C++17: waves that run across a square. */

#include <impinge/model.hpp>

namespace
{

enum { HEIGHT, WAVES, SPEED };

constexpr imp_parameter rows[] = {
    IMP_ROW_POSITIVE("height", "length", "0.1", "height of the waves"),
    IMP_ROW_POSITIVE("waves", "rad/length", "6", "how close they follow each other"),
    IMP_ROW_NUMBER("speed", "rad/time", "3", "how fast they run"),
};

constexpr auto where = [](const double *) -> impinge::domain { return {-1, 1, -1, 1}; };

constexpr auto shape = [](const double *p, const impinge::model &u, const impinge::model &v,
                          const impinge::model &t) -> impinge::point {
    return {u, v, p[HEIGHT] * sin(p[WAVES] * (u + 0.5 * v) - p[SPEED] * t)};
};

constexpr imp_surface_type waves = impinge::surface_from<shape, where>(
    rows,
    {"waves", "waves that run across a square",
     "(u, v, height sin(waves (u + v/2) - speed t)), u and v in [-1, 1]", "waves height=0.2"});

} // namespace

IMPINGE_SURFACE_PLUGIN("waves", "1.0", "MIT", "The Impinge authors", waves);
