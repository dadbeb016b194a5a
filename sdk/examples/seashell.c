/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A type of one formula, with parameters that depend on each other.
 *
 * A seashell: a tube that winds around the z axis and grows as it goes. Compile it with
 * `impinge build seashell.c`, and see `impinge info seashell --plugin-path .` */

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { SIZE, GROWTH, TURNS, CENTER };

static const imp_parameter parameters[] = {
    [SIZE] = IMP_ROW_POSITIVE("size", "length", "1", "radius of the last turn"),
    [GROWTH] = IMP_ROW_BETWEEN("growth", "1/rad", "0.15", 0, 10,
                               "logarithm of how much it grows, per radian"),
    [TURNS] = IMP_ROW("turns", "1", "3", IMP_PARAMETER_MIN_OPEN, 0, 0, 0, 0, 100,
                      "how often it goes around"),
    [CENTER] = IMP_ROW_VECTOR("center", "length", "[0,0,0]", 0, "middle of the last turn"),
};

typedef struct seashell {
    double size, growth, end, center[3]; /* u goes from 0 to end */
} seashell;

/* The host has checked each value on its own. Here we check that they are consistent. */
static imp_status check_together(const imp_value *values, imp_create_error *why)
{
    double grown = values[GROWTH].number[0] * values[TURNS].number[0] * IMP_TWO_PI_UPPER;
    if (grown <= 100) return IMP_STATUS_OK;
    return imp_reject(why, TURNS, -1,
                      "%g turns with growth %g make the first turn e^%g times smaller than the "
                      "last; must be e^100",
                      values[TURNS].number[0], values[GROWTH].number[0], grown);
}

static imp_status seashell_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check_together(values, why);
    if (status != IMP_STATUS_OK) return status;
    seashell *shell = malloc(sizeof *shell);
    if (shell == NULL) return IMP_STATUS_INTERNAL;
    shell->size = values[SIZE].number[0];
    shell->growth = values[GROWTH].number[0];
    shell->end = values[TURNS].number[0] * IMP_TWO_PI_UPPER;
    imp_copy_vector(shell->center, &values[CENTER]);
    *self = shell;
    return IMP_STATUS_OK;
}

static void seashell_domain(const void *self, double lo[3], double hi[3])
{
    const seashell *shell = self;
    imp_set_domain(lo, hi, 0, shell->end, 0, IMP_TWO_PI_UPPER);
}

/* With g = size exp(growth (u - end)):
 *
 *   x = g (1 + cos(v)/2) cos u,   y = g (1 + cos(v)/2) sin u,   z = g sin(v)/2 - 2 g + 2 size
 *
 * The surface is at rest, so t is not used; `... ! translate velocity=1,0,0` moves it. */
static void seashell_formula(const void *self, imp_model u, imp_model v, imp_model t,
                             imp_model out[3])
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
IMP_SURFACE_FORMULA(seashell_formula)

static const imp_surface_type type = {
    IMP_SURFACE_FIELDS(seashell, seashell_formula),
    .summary = "tube that winds around an axis and grows",
    .equation = "g = size exp(growth (u - 2 pi turns)): (g (1 + cos(v)/2) cos u, g (1 + cos(v)/2) "
                "sin u, g sin(v)/2 - 2 g + 2 size) + center",
    .source = "after the logarithmic spiral",
    .example = "seashell size=0.5 turns=2",
};

IMPINGE_SURFACE_PLUGIN("seashell", "1.0", "MIT", "The Impinge authors", type);
