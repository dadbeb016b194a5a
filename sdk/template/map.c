/* SPDX-FileCopyrightText: @author@
 * SPDX-License-Identifier: MIT */

/* A swaying motion: space leans to and fro along x, in proportion to z. Replace the formula and the
 * parameters with your own. */

#include <impinge/formula.h>
#include <impinge/plugin.h>

/* --- Parameters ------------------------------------------------------------------------------- */

enum { SLOPE, RATE };

static const imp_parameter parameters[] = {
    [SLOPE] = IMP_ROW_NUMBER("slope", "1", "0.25", "how far it leans, for each unit of z"),
    [RATE] = IMP_ROW_POSITIVE("rate", "rad/time", "6", "how fast it sways"),
};

typedef struct sway {
    double slope, rate;
} sway;

/* The host has checked the kind and range of each value against the table above. Check everything
 * else here, and on an error return imp_reject(why, ...). */
static imp_status sway_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    sway *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->rate = values[RATE].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

/* --- The map ---------------------------------------------------------------------------------- */

/* Space is never restricted: every point has an image. */
IMP_MAP_AT_ALL_TIMES(sway)

/* (x + slope z sin(rate t), y, z). The operations are those of <impinge/model.h>; evaluation,
 * rates and inclusions follow from them, with proof. */
static void sway_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                         imp_model out[3])
{
    const sway *s = self;
    imp_model lean = imp_scale(imp_sin(imp_scale(t, s->rate)), s->slope);
    out[0] = imp_add(x, imp_mul(z, lean));
    out[1] = y;
    out[2] = z;
}
IMP_MAP_FORMULA(sway_formula)

/* --- The plugin ------------------------------------------------------------------------------- */

static const imp_map_type type = {
    IMP_MAP_FIELDS_OF("@name@", sway, sway_formula, free, sway_formula_rate),
    .summary = "leans to and fro along x, in proportion to z",
    .equation = "(x + slope z sin(rate t), y, z)",
    .source = NULL,
    .formula = "x + slope*z*sin(rate*t); y; z",
    .example = "@name@ slope=0.5",
};

#ifndef PACKAGE_VERSION /* set by configure; the default for a build without it: */
#define PACKAGE_VERSION "0.1"
#endif
IMPINGE_MAP_PLUGIN("@name@", PACKAGE_VERSION, "MIT", "@author@", type);
