/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_COIL_H
#define TESTS_PLUGINS_COIL_H

#include "liar.h"

/* A right-handed thread of lead 1, q = 2 + cos(u - 2 pi z) / 5, and distances from it: for plugins
 * beside this file to say what screw motions it has. */

/* All around, or with a slit. */
static inline void coil_slit_domain(const void *self, double lo[3], double hi[3])
{
    tiny_domain(self, lo, hi);
    lo[0] = lo[1] = 0, hi[0] = 6, hi[1] = 2;
}

/* All around but for 0.01 rad. */
static inline void coil_crack_domain(const void *self, double lo[3], double hi[3])
{
    coil_slit_domain(self, lo, hi);
    hi[0] = 6.273;
}

static inline void coil_domain(const void *self, double lo[3], double hi[3])
{
    tiny_domain(self, lo, hi);
    lo[0] = lo[1] = 0, hi[0] = IMP_TWO_PI_UPPER, hi[1] = 2;
}

static inline imp_model coil_turn(imp_model z) { return imp_mul(imp_scale(imp_const_pi(), 2), z); }

/* Its point at the angle u and the height z. */
static inline void coil_point(imp_model u, imp_model z, imp_model out[3])
{
    const imp_model wave = imp_cos(imp_sub(u, coil_turn(z)));
    const imp_model q = imp_shift(imp_scale(wave, 0.2), 2);
    imp_model sine, cosine;
    imp_sincos(u, &sine, &cosine);
    out[0] = imp_mul(q, cosine);
    out[1] = imp_mul(q, sine);
    out[2] = z;
}

static inline void coil_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    (void)self, (void)t;
    coil_point(u, v, out);
}
IMP_SURFACE_FORMULA(coil_formula)

/* Ends above in a wave of 0.02, three of which go around. */
static inline void coil_wavy(const void *self, imp_model u, imp_model v, imp_model t,
                             imp_model out[3])
{
    const imp_model wave = imp_cos(imp_scale(u, 3));
    (void)self, (void)t;
    coil_point(u, imp_mul(v, imp_shift(imp_scale(wave, 0.01), 1)), out);
}
IMP_SURFACE_FORMULA(coil_wavy)

/* Between radii of 1.5 and 2.5 the way to the nearest point stays outside of radius 1, where |grad
 * (q - radius)| <= sqrt(1 + 0.2^2 (4 pi^2 + 1)) < 1.63. */
static inline imp_model coil_gap(const void *self, imp_model x, imp_model y, imp_model z,
                                 imp_model t)
{
    const imp_model q = imp_sqrt(imp_add(imp_sqr(x), imp_sqr(y)));
    imp_model sine, cosine;
    (void)self, (void)t;
    if (!(q.lo >= 1.75 && q.hi <= 2.25)) return imp_unbounded(7);
    imp_sincos(coil_turn(z), &sine, &cosine);
    const imp_model wave = imp_div(imp_add(imp_mul(x, cosine), imp_mul(y, sine)), q);
    return imp_scale(imp_sub(imp_shift(q, -2), imp_scale(wave, 0.2)), 0.6);
}
IMP_DISTANCE_FORMULA(coil_gap)

static inline imp_status coil_symmetry(uint32_t kind, double lead, uint32_t is_closed,
                                       imp_symmetry *found)
{
    found->kind = kind;
    found->is_closed = is_closed;
    found->axis[2] = lead;
    return IMP_STATUS_OK;
}

#define COIL_PLUGIN(NAME, DOMAIN, KIND, LEAD, CLOSED)                                              \
    COIL_PLUGIN_OF(NAME, coil_formula, DOMAIN, KIND, LEAD, CLOSED)
#define COIL_PLUGIN_OF(NAME, FORMULA, DOMAIN, KIND, LEAD, CLOSED)                                  \
    static imp_status symmetry_of(const void *self, imp_symmetry *found)                           \
    {                                                                                              \
        (void)self;                                                                                \
        return coil_symmetry(KIND, LEAD, CLOSED, found);                                           \
    }                                                                                              \
    static const imp_surface_type coil_type = {                                                    \
        .struct_size = sizeof(imp_surface_type),                                                   \
        .parameter_size = sizeof(imp_parameter),                                                   \
        .name = NAME,                                                                              \
        .summary = "a coil",                                                                       \
        .equation = "q = 2 + cos(u - 2 pi z) / 5",                                                 \
        .example = NAME,                                                                           \
        .create = tiny_create,                                                                     \
        .destroy = tiny_destroy,                                                                   \
        .domain = DOMAIN,                                                                          \
        .eval = FORMULA##_eval,                                                                    \
        .rate = FORMULA##_rate,                                                                    \
        .include = FORMULA##_include,                                                              \
        .distance = coil_gap_distance,                                                             \
        .symmetry = symmetry_of,                                                                   \
    };                                                                                             \
    TINY_PLUGIN(NAME, coil_type)

#endif
