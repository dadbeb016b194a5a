/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <fenv.h>
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "tiny.h"

/* Its renew leaves another rounding mode behind. */

enum { SLOPE, HEIGHT };

static const imp_parameter parameters[] = {
    [SLOPE] = IMP_ROW_NUMBER("slope", "1", "2", "of z along u"),
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "1", "of the corner"),
};

typedef struct renew_rounds_up_instance {
    double slope, height;
} renew_rounds_up_instance;

static imp_status renew_rounds_up_create(const imp_value *values, void **self,
                                         imp_create_error *why)
{
    renew_rounds_up_instance *made = malloc(sizeof *made);
    (void)why;
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->height = values[HEIGHT].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static imp_status renew_rounds_up_renew(void *self, const imp_value *values, imp_create_error *why)
{
    (void)why;
    renew_rounds_up_instance *s = self;
    s->slope = values[SLOPE].number[0];
    s->height = values[HEIGHT].number[0];
    fesetround(FE_UPWARD);
    return IMP_STATUS_OK;
}

static void renew_rounds_up_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void renew_rounds_up_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                    imp_model out[3])
{
    const renew_rounds_up_instance *s = self;
    (void)t;
    out[0] = u;
    out[1] = v;
    out[2] = imp_shift(imp_scale(u, s->slope), s->height);
}
IMP_SURFACE_FORMULA(renew_rounds_up_formula)

static const imp_surface_type renew_rounds_up = {
    IMP_SURFACE_FIELDS(renew_rounds_up, renew_rounds_up_formula),
    .renew = renew_rounds_up_renew,
    .summary = "a liar",
    .equation = "(u, v, height + slope u)",
    .example = "renew_rounds_up slope=2",
};

TINY_PLUGIN("renew_rounds_up", renew_rounds_up);
