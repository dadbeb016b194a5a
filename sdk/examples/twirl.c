/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A map of one formula.
 *
 * A whirl about the z axis: everything turns, the faster the nearer to the axis. */

#include <impinge/formula.h>
#include <stdlib.h>

enum { SPEED, SIZE };

static const imp_parameter parameters[] = {
    [SPEED] = {.name = "speed",
               .unit = "rad/time",
               .doc = "angular velocity at the axis",
               .preset = "1",
               .kind = IMP_NUMBER,
               .min = -INFINITY,
               .max = INFINITY},
    [SIZE] = {.name = "size",
              .unit = "length",
              .doc = "it is half as fast this far from the axis",
              .preset = "1",
              .kind = IMP_NUMBER,
              .flags = IMP_MIN_OPEN,
              .min = 0,
              .max = INFINITY},
};

typedef struct twirl {
    double speed, size;
} twirl;

static imp_status create(const imp_value *values, void **self, imp_complaint *why)
{
    (void)why;
    twirl *made = malloc(sizeof *made);
    if (made == NULL) return IMP_INTERNAL;
    made->speed = values[SPEED].number[0];
    made->size = values[SIZE].number[0];
    *self = made;
    return IMP_OK;
}

static void time_domain(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

/* A = speed t / (1 + (x^2 + y^2) / size^2): (x cos A - y sin A, x sin A + y cos A, z) */
static void formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                    imp_model out[3])
{
    const twirl *map = self;
    imp_model size = imp_num(map->size), sine, cosine;
    imp_model far = imp_add(imp_sqr(imp_div(x, size)), imp_sqr(imp_div(y, size)));
    imp_sincos(imp_div(imp_scale(t, map->speed), imp_shift(far, 1)), &sine, &cosine);
    out[0] = imp_sub(imp_mul(x, cosine), imp_mul(y, sine));
    out[1] = imp_add(imp_mul(x, sine), imp_mul(y, cosine));
    out[2] = z;
}
IMP_MAP_FORMULA(formula)

static const imp_map_type type = {
    .struct_size = (uint32_t)sizeof(imp_map_type),
    .parameter_count = sizeof parameters / sizeof parameters[0],
    .parameter_size = (uint32_t)sizeof(imp_parameter),
    .name = "twirl",
    .summary = "turns about the z axis, the faster the nearer to it",
    .equation = "A = speed t / (1 + (x^2 + y^2)/size^2): (x cos A - y sin A, x sin A + y cos A, z)",
    .source = NULL,
    .example = "twirl speed=2",
    .parameters = parameters,
    .create = create,
    .destroy = free,
    .time_domain = time_domain,
    .eval = formula_eval,
    .rate = formula_rate,
    .apply = formula_apply,
};

IMPINGE_MAP_PLUGIN("twirl", "1.0", "MIT", "The Impinge authors", type);
