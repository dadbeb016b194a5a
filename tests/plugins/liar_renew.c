/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "tiny.h"

/* Its renew leaves the slope of the values before. */

enum { SLOPE, HEIGHT };

static const imp_parameter parameters[] = {
    [SLOPE] = IMP_ROW_NUMBER("slope", "1", "2", "of z along u"),
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "1", "of the corner"),
};

typedef struct liar_renew_instance {
    double slope, height;
} liar_renew_instance;

static imp_status liar_renew_create(const imp_value *values, void **self, imp_create_error *why)
{
    liar_renew_instance *made = malloc(sizeof *made);
    (void)why;
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->height = values[HEIGHT].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static imp_status liar_renew_renew(void *self, const imp_value *values, imp_create_error *why)
{
    (void)why;
    ((liar_renew_instance *)self)->height = values[HEIGHT].number[0];
    return IMP_STATUS_OK;
}

static void liar_renew_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void liar_renew_formula(const void *self, imp_model u, imp_model v, imp_model t,
                               imp_model out[3])
{
    const liar_renew_instance *s = self;
    (void)t;
    out[0] = u;
    out[1] = v;
    out[2] = imp_shift(imp_scale(u, s->slope), s->height);
}
IMP_SURFACE_FORMULA(liar_renew_formula)

static const imp_surface_type liar_renew = {
    IMP_SURFACE_FIELDS(liar_renew, liar_renew_formula),
    .renew = liar_renew_renew,
    .summary = "a liar",
    .equation = "(u, v, height + slope u)",
    .example = "liar_renew slope=2",
};

TINY_PLUGIN("liar_renew", liar_renew);
