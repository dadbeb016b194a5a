/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_TYPE_VIEW_H
#define CORE_PLUGIN_TYPE_VIEW_H

#include <stdbool.h>

#include "core/plugin/parameter_table.h"

/* What surface types and maps have in common
 * ==========================================
 * Both have a name, texts, a parameter table, and are created and destroyed alike. Code that
 * cares for nothing else is written once, for this view. It points into the type. */

typedef struct type_view {
    const char *name, *summary, *equation, *source, *example;
    const char *formula; /* NULL: there is no constant text */
    bool has_formula;    /* that, or the callback */
    const char *parts;   /* of a map that stands for several; NULL: it is one */
    parameter_table table;
    imp_status (*create)(const imp_value *values, void **self, imp_create_error *why);
    void (*destroy)(void *self);
    /* NULL: an instance cannot be refilled. */
    imp_status (*renew)(void *self, const imp_value *values, imp_create_error *why);
} type_view;

/* The fields that surface and map types share by name. */
#define TYPE_VIEW_OF(TYPE)                                                                         \
    {                                                                                              \
        .name = (TYPE)->name, .summary = (TYPE)->summary, .equation = (TYPE)->equation,            \
        .source = (TYPE)->source, .example = (TYPE)->example,                                      \
        .formula = IMP_OFFERS(TYPE, formula) ? (TYPE)->formula : NULL,                             \
        .has_formula = IMP_OFFERS(TYPE, formula) || IMP_OFFERS(TYPE, write_formula),               \
        .table = {(TYPE)->parameters, (TYPE)->parameter_count, (TYPE)->parameter_size},            \
        .create = (TYPE)->create, .destroy = (TYPE)->destroy,                                      \
        .renew = IMP_OFFERS(TYPE, renew) ? (TYPE)->renew : NULL,                                   \
    }

static inline type_view type_view_of_surface(const imp_surface_type *type)
{
    return (type_view)TYPE_VIEW_OF(type);
}

static inline type_view type_view_of_map(const imp_map_type *type)
{
    type_view view = TYPE_VIEW_OF(type);
    view.parts = IMP_OFFERS(type, parts) ? type->parts : NULL;
    return view;
}

#endif
