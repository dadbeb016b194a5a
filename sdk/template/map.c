/* SPDX-FileCopyrightText: @author@
 * SPDX-License-Identifier: MIT */

/* A sway: everything leans to and fro along x, the more the higher it is. Make it yours: change
 * the formula and the parameters. */

#include <impinge/formula.h>
#include <stdlib.h>

/* --- Parameters ------------------------------------------------------------------- */

enum { SLOPE, RATE };

static const imp_parameter parameters[] = {
    [SLOPE] = {.name = "slope",
               .unit = "1",
               .doc = "how far it leans, for each unit of z",
               .preset = "0.25",
               .kind = IMP_NUMBER,
               .min = -INFINITY,
               .max = INFINITY},
    [RATE] = {.name = "rate",
              .unit = "rad/time",
              .doc = "how fast it sways",
              .preset = "6",
              .kind = IMP_NUMBER,
              .flags = IMP_MIN_OPEN,
              .min = 0,
              .max = INFINITY},
};

typedef struct instance {
    double slope, rate;
} instance;

/* The values have passed the table above: the host has checked their kinds and ranges. What it
 * cannot check is checked here: set *why and return IMP_PARAMETER. */
static imp_status create(const imp_value *values, void **self, imp_complaint *why)
{
    (void)why;
    instance *made = malloc(sizeof *made);
    if (made == NULL) return IMP_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->rate = values[RATE].number[0];
    *self = made;
    return IMP_OK;
}

/* --- The map ---------------------------------------------------------------------- */

/* At any time. Space is never restricted: every point has an image. */
static void time_domain(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

/* (x + slope z sin(rate t), y, z). The operations are those of <impinge/model.h>; evaluation,
 * rates and inclusions follow from them, with proof. */
static void formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                    imp_model out[3])
{
    const instance *sway = self;
    imp_model lean = imp_scale(imp_sin(imp_scale(t, sway->rate)), sway->slope);
    out[0] = imp_add(x, imp_mul(z, lean));
    out[1] = y;
    out[2] = z;
}
IMP_MAP_FORMULA(formula)

/* --- What Impinge is told --------------------------------------------------------- */

static const imp_map_type type = {
    .struct_size = (uint32_t)sizeof(imp_map_type),
    .parameter_count = sizeof parameters / sizeof parameters[0],
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "@name@",
    .summary = "leans to and fro along x, the more the higher",
    .equation = "(x + slope z sin(rate t), y, z)",
    .source = NULL,
    .example = "@name@ slope=0.5",
    .parameters = parameters,
    .create = create,
    .destroy = free,
    .time_domain = time_domain,
    .eval = formula_eval,
    .rate = formula_rate,
    .apply = formula_apply,
};

#ifndef PACKAGE_VERSION /* configure.ac says it; where that was not run: */
#define PACKAGE_VERSION "0.1"
#endif
IMPINGE_MAP_PLUGIN("@name@", PACKAGE_VERSION, "MIT", "@author@", type);
