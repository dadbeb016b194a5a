/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* The default of a parameter is out of its range. */
static const imp_parameter table[] = {
    {.name = "radius",
     .unit = "length",
     .doc = "radius",
     .default_value = "-1",
     .kind = IMP_KIND_NUMBER,
     .flags = IMP_PARAMETER_MIN_OPEN,
     .min = 0,
     .max = INFINITY},
};

static const imp_surface_type type =
    TINY_TYPE("bad_parameter_table", tiny_create, tiny_eval, 1, table);
TINY_PLUGIN("bad_parameter_table", type);
