/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <impinge/plugin.h>

/* Its parts name a parameter that it does not have. */

static imp_status bad_parts_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = malloc(1);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static const imp_parameter parameters[] = {
    IMP_ROW_NUMBER("offset", "length", "1", "how far it moves"),
};

static void bad_parts_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                              imp_model out[3])
{
    (void)self, (void)t;
    out[0] = x, out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(bad_parts_formula)
IMP_MAP_AT_ALL_TIMES(bad_parts)

static const imp_map_type bad_parts = {
    IMP_MAP_FIELDS(bad_parts, bad_parts_formula),
    .parts = "translate velocity=1,0,0 clock=-$offset,$ofset",
    .summary = "names a parameter that is not there",
    .equation = "(x, y, z)",
    .example = "bad_parts",
};
IMPINGE_MAP_PLUGIN("bad_parts", "1.0", "Apache-2.0", "tests", bad_parts);
