/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "tiny.h"

/* Its renew forgets a block. */

enum { SLOPE, HEIGHT };

static const imp_parameter parameters[] = {
    [SLOPE] = IMP_ROW_NUMBER("slope", "1", "2", "of z along u"),
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "1", "of the corner"),
};

typedef struct renew_leaks_instance {
    double slope, height;
} renew_leaks_instance;

static imp_status renew_leaks_create(const imp_value *values, void **self, imp_create_error *why)
{
    renew_leaks_instance *made = malloc(sizeof *made);
    (void)why;
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->height = values[HEIGHT].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static void *volatile forgotten;

static imp_status renew_leaks_renew(void *self, const imp_value *values, imp_create_error *why)
{
    (void)why;
    renew_leaks_instance *s = self;
    s->slope = values[SLOPE].number[0];
    s->height = values[HEIGHT].number[0];
    forgotten = malloc(16);
    if (forgotten == NULL) return IMP_STATUS_INTERNAL;
    return IMP_STATUS_OK;
}

static void renew_leaks_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void renew_leaks_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    const renew_leaks_instance *s = self;
    (void)t;
    out[0] = u;
    out[1] = v;
    out[2] = imp_shift(imp_scale(u, s->slope), s->height);
}
IMP_SURFACE_FORMULA(renew_leaks_formula)

static const imp_surface_type renew_leaks = {
    IMP_SURFACE_FIELDS(renew_leaks, renew_leaks_formula),
    .renew = renew_leaks_renew,
    .summary = "a liar",
    .equation = "(u, v, height + slope u)",
    .example = "renew_leaks slope=2",
};

TINY_PLUGIN("renew_leaks", renew_leaks);
