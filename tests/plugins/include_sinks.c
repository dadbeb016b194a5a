/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "slab.h"

/* Says that all of it is 3 lower than it is; its formula is true. */
static imp_status include(const void *self, const imp_region *region, imp_model model[3])
{
    slab_include(self, region, model);
    model[2].a -= 3;
    model[2].lo -= 3;
    model[2].hi -= 3;
    return IMP_STATUS_OK;
}

static const imp_surface_type type = {
    .struct_size = sizeof(imp_surface_type),
    .parameter_count = 1,
    .parameter_size = sizeof(imp_parameter),
    .name = "include_sinks",
    .summary = "a rising square",
    .equation = "(u, v, height + t)",
    .example = "include_sinks",
    .parameters = slab_table,
    .create = slab_create,
    .destroy = slab_destroy,
    .domain = slab_domain,
    .eval = slab_eval,
    .rate = slab_rate,
    .include = include,
    .formula = "u in [-1, 1]; v in [-1, 1]; u; v; height + t",
};
SLAB_PLUGIN("include_sinks", type);
