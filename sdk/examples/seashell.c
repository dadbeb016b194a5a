/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type of one formula, with parameters that depend on each other.
 *
 * A seashell: a tube that winds around the z axis and grows as it goes. Compile it with
 * `impinge build seashell.c`, and see `impinge info seashell --plugin-path .` */

#include <impinge/formula.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE, GROWTH, TURNS, CENTER };

static const imp_parameter parameters[] = {
    [SIZE] = {.name = "size",
              .unit = "length",
              .doc = "radius of the last turn",
              .preset = "1",
              .kind = IMP_NUMBER,
              .flags = IMP_MIN_OPEN,
              .min = 0,
              .max = INFINITY},
    [GROWTH] = {.name = "growth",
                .unit = "1/rad",
                .doc = "logarithm of how much it grows, per radian",
                .preset = "0.15",
                .kind = IMP_NUMBER,
                .min = 0,
                .max = 10},
    [TURNS] = {.name = "turns",
               .unit = "1",
               .doc = "how often it goes around",
               .preset = "3",
               .kind = IMP_NUMBER,
               .flags = IMP_MIN_OPEN,
               .min = 0,
               .max = 100},
    [CENTER] = {.name = "center",
                .unit = "length",
                .doc = "middle of the last turn",
                .preset = "[0,0,0]",
                .kind = IMP_NUMBER,
                .rank = 1,
                .extent = {3},
                .min = -INFINITY,
                .max = INFINITY},
};

/* The least double above 2 pi: angles up to it surely reach all the way round. */
#define ABOVE_TWO_PI 0x1.921fb54442d19p+2

typedef struct seashell {
    double size, growth, end, center[3]; /* u goes from 0 to end */
} seashell;

/* The host has checked each value by itself; that they fit each other is for us to check. */
static imp_status check_together(const imp_value *values, imp_complaint *why)
{
    double grown = values[GROWTH].number[0] * values[TURNS].number[0] * ABOVE_TWO_PI;
    if (grown <= 100) return IMP_OK;
    why->parameter = TURNS;
    snprintf(why->text, sizeof why->text,
             "%g turns with growth %g make the first turn e^%g times smaller than the last; "
             "allowed is e^100",
             values[TURNS].number[0], values[GROWTH].number[0], grown);
    return IMP_PARAMETER;
}

static imp_status create(const imp_value *values, void **self, imp_complaint *why)
{
    imp_status status = check_together(values, why);
    if (status != IMP_OK) return status;
    seashell *shell = malloc(sizeof *shell);
    if (shell == NULL) return IMP_INTERNAL;
    shell->size = values[SIZE].number[0];
    shell->growth = values[GROWTH].number[0];
    shell->end = values[TURNS].number[0] * ABOVE_TWO_PI;
    for (int i = 0; i < 3; ++i) shell->center[i] = values[CENTER].number[i];
    *self = shell;
    return IMP_OK;
}

static void domain(const void *self, double lo[3], double hi[3])
{
    const seashell *shell = self;
    lo[0] = 0, hi[0] = shell->end;
    lo[1] = 0, hi[1] = ABOVE_TWO_PI;
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

/* With g = size exp(growth (u - end)):
 *
 *   x = g (1 + cos(v)/2) cos u,   y = g (1 + cos(v)/2) sin u,   z = g sin(v)/2 - 2 g + 2 size
 *
 * It does not move, so t is not used; `... ! translate velocity=1,0,0` moves it. */
static void formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const seashell *shell = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    imp_model grown = imp_exp(imp_scale(imp_shift(u, -shell->end), shell->growth));
    imp_model g = imp_scale(grown, shell->size);
    imp_model ring = imp_mul(g, imp_shift(imp_scale(cos_v, 0.5), 1));
    imp_model rise = imp_mul(g, imp_shift(imp_scale(sin_v, 0.5), -2));
    out[0] = imp_shift(imp_mul(ring, cos_u), shell->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), shell->center[1]);
    out[2] = imp_shift(imp_shift(rise, 2 * shell->size), shell->center[2]);
}
IMP_SURFACE_FORMULA(formula)

static const imp_surface_type type = {
    .struct_size = (uint32_t)sizeof(imp_surface_type),
    .parameter_count = sizeof parameters / sizeof parameters[0],
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "seashell",
    .summary = "tube that winds around an axis and grows",
    .equation = "g = size exp(growth (u - 2 pi turns)): (g (1 + cos(v)/2) cos u, g (1 + cos(v)/2) "
                "sin u, g sin(v)/2 - 2 g + 2 size) + center",
    .source = "after the logarithmic spiral",
    .example = "seashell size=0.5 turns=2",
    .parameters = parameters,
    .create = create,
    .destroy = free,
    .domain = domain,
    .eval = formula_eval,
    .rate = formula_rate,
    .include = formula_include,
};

IMPINGE_SURFACE_PLUGIN("seashell", "1.0", "MIT", "The Impinge authors", type);
