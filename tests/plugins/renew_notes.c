/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "tiny.h"

/* Its renew notes what create does not. */

enum { SLOPE, HEIGHT };

static const imp_parameter parameters[] = {
    [SLOPE] = IMP_ROW_NUMBER("slope", "1", "2", "of z along u"),
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "1", "of the corner"),
};

typedef struct renew_notes_instance {
    double slope, height;
} renew_notes_instance;

static imp_status renew_notes_create(const imp_value *values, void **self, imp_create_error *why)
{
    renew_notes_instance *made = malloc(sizeof *made);
    (void)why;
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->slope = values[SLOPE].number[0];
    made->height = values[HEIGHT].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static imp_status renew_notes_renew(void *self, const imp_value *values, imp_create_error *why)
{
    renew_notes_instance *s = self;
    s->slope = values[SLOPE].number[0];
    s->height = values[HEIGHT].number[0];
    imp_note(why, SLOPE, 1, "a slope was taken");
    return IMP_STATUS_OK;
}

static void renew_notes_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static void renew_notes_formula(const void *self, imp_model u, imp_model v, imp_model t,
                                imp_model out[3])
{
    const renew_notes_instance *s = self;
    (void)t;
    out[0] = u;
    out[1] = v;
    out[2] = imp_shift(imp_scale(u, s->slope), s->height);
}
IMP_SURFACE_FORMULA(renew_notes_formula)

static const imp_surface_type renew_notes = {
    IMP_SURFACE_FIELDS(renew_notes, renew_notes_formula),
    .renew = renew_notes_renew,
    .summary = "a liar",
    .equation = "(u, v, height + slope u)",
    .example = "renew_notes slope=2",
};

TINY_PLUGIN("renew_notes", renew_notes);
