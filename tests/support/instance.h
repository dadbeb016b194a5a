/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_INSTANCE_H
#define TESTS_SUPPORT_INSTANCE_H

#include <stdint.h>

#include "core/plugin/registry.h"
#include "core/plugin/type_view.h"
#include "tests/support/type_oracle.h"

/* Instances of types, made from the JSON templates of type_oracle.h. */

typedef struct instance {
    const imp_surface_type *surface; /* one of the two is NULL */
    const imp_map_type *map;
    type_view view;
    char *text; /* the parameters, drawn */
    json_t *json;
    parameter_values values;
    type_arguments arguments;
    void *self;
} instance;

/* Text of a template with all numbers drawn; the caller owns it. */
char *template_draw(const char *template, uint64_t *random);

/* Draws from the template and creates. Aborts the test if that fails. */
instance instance_make(const imp_registry *registry, const char *type, const char *template,
                       uint64_t *random);
void instance_free(instance *made);

#endif
