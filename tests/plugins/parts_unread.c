/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <impinge/plugin.h>
#include <string.h>

/* Maps whose tables are in order, and whose parts cannot be read in a scene. */

static imp_status parts_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)values, (void)why;
    *self = malloc(1);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static const imp_parameter parameters[] = {
    IMP_ROW_NUMBER("offset", "length", "1", "how far it moves"),
};

static void parts_formula(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                          imp_model out[3])
{
    (void)self, (void)t;
    out[0] = x, out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(parts_formula)
IMP_MAP_AT_ALL_TIMES(parts)

#define UNREAD(NAME, PARTS)                                                                        \
    static const imp_map_type NAME##_type = {                                                      \
        IMP_MAP_FIELDS_OF(#NAME, parts, parts_formula, free, parts_formula_rate), .parts = PARTS,  \
        .summary = "a map of parts", .equation = "(x, y, z)", .example = #NAME}

UNREAD(parts_unknown, "nothing_like_it clock=-$offset,$offset");
UNREAD(parts_of_parts, "tolerance offset=$offset");
UNREAD(parts_empty, "");
UNREAD(parts_reversed, "translate velocity=1,0,0 clock=$offset,-$offset");

static const imp_map_type *const maps[] = {&parts_unknown_type, &parts_of_parts_type,
                                           &parts_empty_type, &parts_reversed_type};
static const imp_map_factory factory = {sizeof factory, sizeof maps / sizeof *maps, maps};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_MAP_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("parts_unread", "1.0", "Apache-2.0", "tests", get_factory);
