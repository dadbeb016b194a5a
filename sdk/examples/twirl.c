/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: MIT */

/* A map of one formula.
 *
 * A whirl about the z axis: space turns, faster near the axis. */

#include <impinge/formula.h>
#include <impinge/plugin.h>

enum { SPEED, SIZE };

static const imp_parameter parameters[] = {
    [SPEED] = IMP_ROW_NUMBER("speed", "rad/time", "1", "angular velocity at the axis"),
    [SIZE] = IMP_ROW_POSITIVE("size", "length", "1",
                              "distance from the axis at which the speed is halved"),
};

typedef struct twirl {
    double speed, size;
} twirl;

static imp_status twirl_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    twirl *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->speed = values[SPEED].number[0];
    made->size = values[SIZE].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

IMP_MAP_AT_ALL_TIMES(twirl)

/* A = speed t / (1 + (x^2 + y^2) / size^2): (x cos A - y sin A, x sin A + y cos A, z) */
static void twirl_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
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
IMP_MAP_FORMULA(twirl_formula)

static const imp_map_type type = {
    IMP_MAP_FIELDS(twirl, twirl_formula),
    .summary = "turns about the z axis, faster near it",
    .equation = "A = speed t / (1 + (x^2 + y^2)/size^2): (x cos A - y sin A, x sin A + y cos A, z)",
    .source = NULL,
    .example = "twirl speed=2",
};

IMPINGE_MAP_PLUGIN("twirl", "1.0", "MIT", "The Impinge authors", type);
