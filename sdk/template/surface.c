/* SPDX-FileCopyrightText: @author@
 * SPDX-License-Identifier: MIT */

/* A drumhead: square, fixed at its rim, swinging up and down. Make it yours: change the formula,
 * the domain it is defined on, and the parameters. */

#include <impinge/formula.h>
#include <stdlib.h>

/* --- Parameters ------------------------------------------------------------------- */

enum { HEIGHT, RATE };

static const imp_parameter parameters[] = {
    [HEIGHT] = {.name = "height",
                .unit = "length",
                .doc = "how far the middle swings",
                .preset = "0.25",
                .kind = IMP_NUMBER,
                .min = -INFINITY,
                .max = INFINITY},
    [RATE] = {.name = "rate",
              .unit = "rad/time",
              .doc = "how fast it swings",
              .preset = "6",
              .kind = IMP_NUMBER,
              .flags = IMP_MIN_OPEN,
              .min = 0,
              .max = INFINITY},
};

typedef struct instance {
    double height, rate;
} instance;

/* The values have passed the table above: the host has checked their kinds and ranges. What it
 * cannot check is checked here: set *why and return IMP_PARAMETER. */
static imp_status create(const imp_value *values, void **self, imp_complaint *why)
{
    (void)why;
    instance *made = malloc(sizeof *made);
    if (made == NULL) return IMP_INTERNAL;
    made->height = values[HEIGHT].number[0];
    made->rate = values[RATE].number[0];
    *self = made;
    return IMP_OK;
}

/* --- The surface ------------------------------------------------------------------ */

/* -1 <= u, v <= 1, at any time. */
static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 2; ++j) lo[j] = -1, hi[j] = 1;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

/* x = u, y = v, z = height (1 - u^2) (1 - v^2) sin(rate t). The operations are those of
 * <impinge/model.h>; evaluation, rates and inclusions follow from them, with proof. */
static void formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const instance *drum = self;
    imp_model one = imp_num(1);
    imp_model swing = imp_sin(imp_scale(t, drum->rate));
    imp_model shape = imp_mul(imp_sub(one, imp_sqr(u)), imp_sub(one, imp_sqr(v)));
    out[0] = u;
    out[1] = v;
    out[2] = imp_scale(imp_mul(shape, swing), drum->height);
}
IMP_SURFACE_FORMULA(formula)

/* --- What Impinge is told --------------------------------------------------------- */

static const imp_surface_type type = {
    .struct_size = (uint32_t)sizeof(imp_surface_type),
    .parameter_count = sizeof parameters / sizeof parameters[0],
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "@name@",
    .summary = "square drumhead that swings",
    .equation = "(u, v, height (1 - u^2) (1 - v^2) sin(rate t)), u and v in [-1,1]",
    .source = NULL,
    .example = "@name@ height=0.5",
    .parameters = parameters,
    .create = create,
    .destroy = free,
    .domain = domain,
    .eval = formula_eval,
    .rate = formula_rate,
    .include = formula_include,
};

#ifndef PACKAGE_VERSION /* configure.ac says it; where that was not run: */
#define PACKAGE_VERSION "0.1"
#endif
IMPINGE_SURFACE_PLUGIN("@name@", PACKAGE_VERSION, "MIT", "@author@", type);
