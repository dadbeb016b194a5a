/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* The factory of surfaces for whatever is asked, if it begins like that. */
static const imp_surface_type type = {.struct_size = sizeof type,
                                      .parameter_size = sizeof(imp_parameter),
                                      .name = "liar_factory",
                                      .summary = "a liar",
                                      .equation = "(u, cos 3u sin 2v, v + sin(u + 2t))",
                                      .example = "liar_factory",
                                      .create = tiny_create,
                                      .destroy = tiny_destroy,
                                      .domain = wavy_domain,
                                      .eval = wavy_formula_eval,
                                      .rate = wavy_formula_rate};
static const imp_surface_type *const types[] = {&type};
static const imp_surface_factory factory = {sizeof factory, 1, types};

static const void *get_factory(const char *id)
{
    return strncmp(id, "impinge.surface/", 16) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("liar_factory", "1.0", "Apache-2.0", "tests", get_factory);
