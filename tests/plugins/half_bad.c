/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* The first type is in order, the second is not. */
static const imp_surface_type good = TINY_TYPE("half_good", tiny_create, tiny_eval, 0, NULL);
static const imp_surface_type bad = TINY_TYPE("half_bad", NULL, tiny_eval, 0, NULL);
static const imp_surface_type *const types[] = {&good, &bad};
static const imp_surface_factory factory = {sizeof factory, 2, types};

static const void *get_factory(const char *id)
{
    return id[8] == 's' ? &factory : NULL; /* "impinge.surface/1" */
}
IMPINGE_PLUGIN("half_bad", "1.0", "Apache-2.0", "tests", get_factory);
