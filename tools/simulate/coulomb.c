/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/coulomb.h"

/* The velocity along and across the normal when the impulse slides in the direction d with friction
 * mu: its normal part is such that the normal velocity, `free` without impulse, becomes 0. */
typedef struct slide {
    double normal; /* impulse; <= 0: there is none */
    vec velocity;
    double across; /* velocity across d */
} slide;

static slide slide_along(const mat3 *k, vec free, double mu, double angle)
{
    const vec way = {{1, mu * cos(angle), mu * sin(angle)}}, yield = mat3_apply(k, way);
    slide s = {.normal = yield.x[0] > 0 ? -free.x[0] / yield.x[0] : 0};
    s.velocity = vec_along(free, s.normal, yield);
    s.across = s.velocity.x[1] * sin(angle) - s.velocity.x[2] * cos(angle);
    return s;
}

/* Returns whether the slide at the angle opposes its friction. */
static bool is_opposed(const slide *s, double angle)
{
    return s->normal > 0 && s->velocity.x[1] * cos(angle) + s->velocity.x[2] * sin(angle) <= 0;
}

/* An angle between two at which the velocities across the direction have opposite signs where it is
 * 0, by the Illinois method. */
static double find_zero(const mat3 *k, vec free, double mu, double a, double b)
{
    enum { STEPS = 60 };
    double at_a = slide_along(k, free, mu, a).across, at_b = slide_along(k, free, mu, b).across;
    for (int n = 0; n < STEPS && at_b != 0 && fabs(b - a) > 1e-15; ++n) {
        const double c = b - at_b * (b - a) / (at_b - at_a);
        const double at_c = slide_along(k, free, mu, c).across;
        if ((at_c > 0) != (at_b > 0))
            a = b, at_a = at_b;
        else
            at_a /= 2;
        b = c, at_b = at_c;
    }
    return b;
}

/* Returns the impulse of a point that slides: there the velocity across its direction is 0. Looked
 * for around an angle that is likely, farther and farther away. Without one friction is left out.
 * */
static vec sliding_impulse(const mat3 *k, vec free, double mu, double likely)
{
    double angle[2] = {likely, likely}; /* the ends of what was looked at */
    slide end[2] = {slide_along(k, free, mu, likely), slide_along(k, free, mu, likely)};
    for (double step = 0.01; step < 5; step *= 1.5)
        for (int side = 0; side < 2; ++side) {
            const double next = likely + (side == 0 ? -1 : 1) * fmin(step, 3.2);
            const slide s = slide_along(k, free, mu, next), *before = &end[side];
            if (before->normal > 0 && s.normal > 0 && before->across * s.across <= 0) {
                const double zero = find_zero(k, free, mu, angle[side], next);
                const slide found = slide_along(k, free, mu, zero);
                if (is_opposed(&found, zero))
                    return vec_scale(found.normal, (vec){{1, mu * cos(zero), mu * sin(zero)}});
            }
            angle[side] = next, end[side] = s;
        }
    return (vec){{-free.x[0] / k->m[0][0], 0, 0}};
}

vec coulomb_impulse(const mat3 *k, const mat3 *inverse, vec free, double mu, vec now)
{
    if (free.x[0] >= 0) return (vec){{0, 0, 0}};
    if (!(mu > 0)) return (vec){{-free.x[0] / k->m[0][0], 0, 0}};
    const vec stick = vec_scale(-1, mat3_apply(inverse, free));
    if (stick.x[0] > 0 && hypot(stick.x[1], stick.x[2]) <= mu * stick.x[0]) return stick;
    const vec against = now.x[1] != 0 || now.x[2] != 0 ? now : vec_scale(-1, free);
    return sliding_impulse(k, free, mu, atan2(against.x[2], against.x[1]));
}
