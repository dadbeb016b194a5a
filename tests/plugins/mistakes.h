/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_MISTAKES_H
#define TESTS_PLUGINS_MISTAKES_H

#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* A tube whose radius waves, and which drifts along its axis:
 *
 *   ((radius + wave sin(3v + t)) cos u, (radius + wave sin(3v + t)) sin u, 2v + path(t)),
 *   u in [0, 2 pi], v in [-1, 2]; path is a polynomial, lowest degree first
 *
 * Each type in the files mistakes_*.c takes it, whose callbacks are all in order, and makes one
 * mistake that authors of plugins make. The type's name says which. */

enum { RADIUS, WAVE, PATH, TUBE_ROWS, COEFFICIENTS = 8 };

static const imp_parameter tube_table[TUBE_ROWS] = {
    [RADIUS] = {.name = "radius",
                .unit = "length",
                .doc = "mean radius",
                .default_value = "1",
                .kind = IMP_KIND_NUMBER,
                .flags = IMP_PARAMETER_MIN_OPEN,
                .min = 0,
                .max = 1e6},
    [WAVE] = {.name = "wave",
              .unit = "length",
              .doc = "how much the radius waves",
              .default_value = "0.25",
              .kind = IMP_KIND_NUMBER,
              .min = -1e6,
              .max = 1e6},
    [PATH] = {.name = "path",
              .unit = "length",
              .doc = "z of v = 0, a polynomial in time",
              .default_value = "[0, 0.5, 0.25]",
              .kind = IMP_KIND_NUMBER,
              .flags = IMP_PARAMETER_SCALAR_OK,
              .rank = 1,
              .min = -1e6,
              .max = 1e6},
};

#define TUBE_EXAMPLE " radius=1.5 wave=0.3 path=0.1,0.5,0.125"

typedef struct tube {
    double radius, wave, path[COEFFICIENTS];
    size_t count;
} tube;

static inline imp_status tube_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    if (values[PATH].count > COEFFICIENTS) return IMP_STATUS_PARAMETER;
    tube *made = calloc(1, sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->radius = values[RADIUS].number[0];
    made->wave = values[WAVE].number[0];
    made->count = values[PATH].count;
    memcpy(made->path, values[PATH].number, made->count * sizeof *made->path);
    *self = made;
    return IMP_STATUS_OK;
}

static inline void tube_destroy(void *self) { free(self); }

static inline void tube_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    lo[0] = 0, hi[0] = 0x1.921fb54442d19p+2; /* the double above 2 pi */
    lo[1] = -1, hi[1] = 2;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

static inline imp_model tube_radius(const tube *a, imp_model v, imp_model t)
{
    return imp_shift(imp_scale(imp_sin(imp_add(imp_scale(v, 3), t)), a->wave), a->radius);
}

static inline void tube_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    const tube *a = self;
    const imp_model r = tube_radius(a, v, t);
    out[0] = imp_mul(r, imp_cos(u));
    out[1] = imp_mul(r, imp_sin(u));
    out[2] = imp_add(imp_scale(v, 2), imp_poly(a->path, a->count, t));
}
IMP_SURFACE_FORMULA(tube_formula)

/* --- The same in plain double arithmetic ------------------------------------------------------ */

static inline double path_at(const tube *a, double t)
{
    double sum = 0;
    for (size_t k = a->count; k-- > 0;) sum = sum * t + a->path[k];
    return sum;
}

static inline double path_slope(const tube *a, double t)
{
    double sum = 0;
    for (size_t k = a->count; k-- > 1;) sum = sum * t + (double)k * a->path[k];
    return sum;
}

static inline void tube_point(const tube *a, const double p[3], double x[3])
{
    const double r = a->radius + a->wave * sin(3 * p[1] + p[2]);
    x[0] = r * cos(p[0]), x[1] = r * sin(p[0]), x[2] = 2 * p[1] + path_at(a, p[2]);
}

/* The derivatives at one point. */
static inline void tube_slopes(const tube *a, const double p[3], double m[3][3])
{
    const double r = a->radius + a->wave * sin(3 * p[1] + p[2]);
    const double bend = a->wave * cos(3 * p[1] + p[2]);
    const double slopes[3][3] = {{-r * sin(p[0]), 3 * bend * cos(p[0]), bend * cos(p[0])},
                                 {r * cos(p[0]), 3 * bend * sin(p[0]), bend * sin(p[0])},
                                 {0, 2, path_slope(a, p[2])}};
    memcpy(m, slopes, sizeof slopes);
}

/* --- Types ------------------------------------------------------------------------------------ */

#define MISTAKE(NAME, CREATE, DESTROY, DOMAIN, EVAL, RATE, INCLUDE)                                \
    static const imp_surface_type NAME##_type = {                                                  \
        .struct_size = sizeof(imp_surface_type),                                                   \
        .parameter_count = TUBE_ROWS,                                                              \
        .parameter_size = sizeof(imp_parameter),                                                   \
        .name = #NAME,                                                                             \
        .summary = "a tube with a mistake",                                                        \
        .equation = "((radius + wave sin(3v + t)) (cos u, sin u), 2v + path(t))",                  \
        .example = #NAME TUBE_EXAMPLE,                                                             \
        .parameters = tube_table,                                                                  \
        .create = CREATE,                                                                          \
        .destroy = DESTROY,                                                                        \
        .domain = DOMAIN,                                                                          \
        .eval = EVAL,                                                                              \
        .rate = RATE,                                                                              \
        .include = INCLUDE}

/* In order but for the one named. */
#define MISTAKE_CREATE(NAME, CREATE, DESTROY)                                                      \
    MISTAKE(NAME, CREATE, DESTROY, tube_domain, tube_formula_eval, tube_formula_rate,              \
            tube_formula_include)
#define MISTAKE_DOMAIN(NAME, DOMAIN)                                                               \
    MISTAKE(NAME, tube_create, tube_destroy, DOMAIN, tube_formula_eval, tube_formula_rate,         \
            tube_formula_include)
#define MISTAKE_EVAL(NAME, EVAL)                                                                   \
    MISTAKE(NAME, tube_create, tube_destroy, tube_domain, EVAL, tube_formula_rate,                 \
            tube_formula_include)
#define MISTAKE_RATE(NAME, RATE)                                                                   \
    MISTAKE(NAME, tube_create, tube_destroy, tube_domain, tube_formula_eval, RATE,                 \
            tube_formula_include)
#define MISTAKE_INCLUDE(NAME, INCLUDE)                                                             \
    MISTAKE(NAME, tube_create, tube_destroy, tube_domain, tube_formula_eval, tube_formula_rate,    \
            INCLUDE)
#define MISTAKE_FORMULA(NAME, FORMULA)                                                             \
    MISTAKE(NAME, tube_create, tube_destroy, tube_domain, FORMULA##_eval, FORMULA##_rate,          \
            FORMULA##_include)

#define MISTAKES(NAME, ...)                                                                        \
    static const imp_surface_type *const mistakes[] = {__VA_ARGS__};                               \
    static const imp_surface_factory mistakes_factory = {                                          \
        sizeof mistakes_factory, sizeof mistakes / sizeof *mistakes, mistakes};                    \
    static const void *get_factory(const char *id)                                                 \
    {                                                                                              \
        return strcmp(id, IMP_SURFACE_FACTORY) == 0 ? &mistakes_factory : NULL;                    \
    }                                                                                              \
    IMPINGE_PLUGIN(NAME, "1.0", "Apache-2.0", "tests", get_factory)

#endif
