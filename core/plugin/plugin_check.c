/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/common/capabilities.h"
#include "core/plugin/parameters.h"
#include "core/plugin/plugin_check.h"
#include "core/plugin/plugin_check_row.h"
#include "core/plugin/type_view.h"

#include <stdio.h>
#include <string.h>

/* A count beyond these is not a big plugin but a broken one, and would be read past its end. */
#define TYPES_MAX 4096u
#define PARAMETERS_MAX 256u

/* --- The entry -------------------------------------------------------------------------------- */

static imp_code fault(imp_error *error, const char *what, const char *allowed)
{
    return error_set(error, IMP_ERROR_PLUGIN, "impinge_plugin: %s; %s", what, allowed);
}

static imp_code check_head(const imp_plugin *entry, imp_error *error)
{
    if (entry->magic != IMP_PLUGIN_MAGIC)
        return fault(error, "magic is wrong", "define the plugin by the macro IMPINGE_PLUGIN");
    if (entry->struct_size < sizeof *entry)
        return error_set(error, IMP_ERROR_PLUGIN,
                         "impinge_plugin: struct_size is %u, must be >= %zu; rebuild the plugin",
                         entry->struct_size, sizeof *entry);
    char text[320];
    if (!elf_probe_abi_fits(entry->abi_major, entry->abi_minor, text, sizeof text))
        return error_set(error, IMP_ERROR_PLUGIN, "impinge_plugin: %s", text);
    return IMP_SUCCESS;
}

/* A text that a plugin gives, in a form that can be shown. */
typedef struct shown_text {
    char at[90];
} shown_text;

static shown_text shown(const char *text)
{
    shown_text s = {"NULL"};
    if (text == NULL) return s;
    snprintf(s.at, sizeof s.at, "'%.80s'", text);
    text_clean(s.at);
    return s;
}

typedef struct text_field {
    const char *name, *text;
} text_field;

/* The first that is not a line of text, or NULL. */
static const text_field *field_without_line(const text_field *fields, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (!text_is_line(fields[k].text)) return &fields[k];
    return NULL;
}

static imp_code check_strings(const imp_plugin *entry, imp_error *error)
{
    const text_field fields[] = {
        {"version", entry->version}, {"license", entry->license}, {"author", entry->author}};
    if (!text_is_line(entry->name) || entry->name[0] == '\0' || strlen(entry->name) > TEXT_NAME_MAX)
        return error_set(error, IMP_ERROR_PLUGIN,
                         "impinge_plugin: name is %s; must be a line of 1 to 63 bytes",
                         shown(entry->name).at);
    const text_field *wrong = field_without_line(fields, sizeof fields / sizeof *fields);
    if (wrong == NULL) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_PLUGIN, "impinge_plugin: %s is %s; must be a line of text",
                     wrong->name, shown(wrong->text).at);
}

static imp_code check_agreement(const imp_plugin *entry, const elf_probe *note, imp_error *error)
{
    bool same = entry->abi_major == note->abi_major && entry->abi_minor == note->abi_minor &&
                strcmp(entry->name, note->name) == 0 && strcmp(entry->version, note->version) == 0;
    if (same) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_PLUGIN,
                     "impinge_plugin says %s %s, ABI %u.%u, but the note in the file says %s %s, "
                     "ABI %u.%u; define both by the macro IMPINGE_PLUGIN",
                     entry->name, entry->version, entry->abi_major, entry->abi_minor, note->name,
                     note->version, note->abi_major, note->abi_minor);
}

imp_code plugin_check_entry(const imp_plugin *entry, const elf_probe *note, imp_error *error)
{
    imp_code code = check_head(entry, error);
    if (code == IMP_SUCCESS) code = check_strings(entry, error);
    if (code == IMP_SUCCESS && note != NULL) code = check_agreement(entry, note, error);
    if (code == IMP_SUCCESS && entry->get_factory == NULL)
        code = fault(error, "get_factory is NULL", "without it no type can be found");
    return code;
}

/* --- A type ----------------------------------------------------------------------------------- */

static imp_code check_table(const parameter_table *table, const place *type, imp_error *error)
{
    if (table->count > PARAMETERS_MAX || (table->count > 0 && table->rows == NULL))
        return place_error(type, error, IMP_ERROR_PLUGIN,
                           "parameter_count is %zu, parameters is %s; must be 0 to %u rows",
                           table->count, table->rows != NULL ? "a table" : "NULL", PARAMETERS_MAX);
    if (table->stride < sizeof(imp_parameter) || table->stride % sizeof(double) != 0)
        return place_error(type, error, IMP_ERROR_PLUGIN,
                           "parameter_size is %zu, must be sizeof(imp_parameter), here %zu",
                           table->stride, sizeof(imp_parameter));
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < table->count && code == IMP_SUCCESS; ++i)
        code = plugin_check_row(table, i, type, error);
    return code;
}

/* Every $NAME in the parts is a parameter of numbers that is always there. */
static imp_code check_parts(const type_view *view, const place *type, imp_error *error)
{
    char name[TEXT_NAME_MAX + 1];
    for (const char *at = strchr(view->parts, '$'); at != NULL; at = strchr(at + 1, '$')) {
        const size_t length = parameter_name_length(at + 1);
        snprintf(name, sizeof name, "%.*s", (int)length, at + 1);
        const ptrdiff_t row = length < sizeof name ? parameter_table_find(&view->table, name) : -1;
        const imp_parameter *of = row < 0 ? NULL : parameter_table_row(&view->table, (size_t)row);
        if (of == NULL || of->kind != IMP_KIND_NUMBER || (of->flags & IMP_PARAMETER_OPTIONAL) != 0)
            return place_error(type, error, IMP_ERROR_PLUGIN,
                               "parts name '$%s', which must be a parameter of numbers that is "
                               "required or has a default",
                               name);
    }
    return IMP_SUCCESS;
}

/* The name first: other faults are reported with it. */
static imp_code check_view(const type_view *view, const char *null_callback, imp_error *error)
{
    const text_field fields[] = {{"summary", view->summary},
                                 {"equation", view->equation},
                                 {"example", view->example},
                                 {"source", view->source != NULL ? view->source : ""},
                                 {"formula", view->formula != NULL ? view->formula : ""},
                                 {"parts", view->parts != NULL ? view->parts : ""}};
    if (!text_is_name(view->name, "_-"))
        return error_set(
            error, IMP_ERROR_PLUGIN,
            "a type's name is %s; must be 1 to 63 letters, digits, '_' and '-', a letter "
            "first",
            shown(view->name).at);
    place type = place_argument(NULL, view->name);
    const text_field *wrong = field_without_line(fields, sizeof fields / sizeof *fields);
    if (wrong != NULL)
        return place_error(&type, error, IMP_ERROR_PLUGIN, "%s is %s; must be a line of text",
                           wrong->name, shown(wrong->text).at);
    if (null_callback != NULL)
        return place_error(&type, error, IMP_ERROR_PLUGIN,
                           "%s is NULL; only include, apply, net, rigid, span, distance, symmetry, "
                           "tube, formula and write_formula may be",
                           null_callback);
    const imp_code code = check_table(&view->table, &type, error);
    return code == IMP_SUCCESS && view->parts != NULL ? check_parts(view, &type, error) : code;
}

/* `allowed`: all flags that the type may have. *name is read only after the size is known to
 * include it. */
static imp_code check_size(uint32_t size, size_t least, const char *const *name, uint32_t flags,
                           uint32_t allowed, imp_error *error)
{
    if (size < least)
        return error_set(error, IMP_ERROR_PLUGIN,
                         "a type's struct_size is %u, must be >= %zu; rebuild the plugin", size,
                         least);
    if ((flags & ~allowed) == 0) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_PLUGIN,
                     "%s: flags has unknown bits: %#x, allowed are those of %#x", shown(*name).at,
                     flags & ~allowed, allowed);
}

/* Callbacks appended since may be missing. */
#define SURFACE_TYPE_FIRST offsetof(imp_surface_type, piece_count)
#define MAP_TYPE_FIRST offsetof(imp_map_type, rigid)

static imp_code check_surface(const imp_surface_type *type, imp_error *error)
{
    imp_code code = check_size(type->struct_size, SURFACE_TYPE_FIRST, &type->name, type->flags,
                               IMP_FLAG_ABSENT_OUTSIDE_TIMES, error);
    if (code != IMP_SUCCESS) return code;
    type_view view = type_view_of_surface(type);
    const char *null_callback = type->create == NULL    ? "create"
                                : type->destroy == NULL ? "destroy"
                                : type->domain == NULL  ? "domain"
                                : type->eval == NULL    ? "eval"
                                : type->rate == NULL    ? "rate"
                                                        : NULL;
    code = check_view(&view, null_callback, error);
    if (code != IMP_SUCCESS) return code;
    const place at = place_argument(NULL, view.name);
    for (capability k = CAPABILITY_CORE; k < CAPABILITIES; ++k) {
        const capability_row *row = &capabilities[k];
        if (surface_type_offers(type, k) && !surface_type_offers(type, row->needs))
            return place_error(&at, error, IMP_ERROR_PLUGIN,
                               "%s is NULL, but %s is given; it says %s",
                               capabilities[row->needs].name, row->name, row->why);
    }
    if (!IMP_HAS(type, piece) || (type->piece_count == NULL) == (type->piece == NULL))
        return IMP_SUCCESS;
    return place_error(&at, error, IMP_ERROR_PLUGIN,
                       "%s is NULL; give piece_count and piece, or neither",
                       type->piece == NULL ? "piece" : "piece_count");
}

static imp_code check_map(const imp_map_type *type, imp_error *error)
{
    const uint32_t flags = IMP_FLAG_ABSENT_OUTSIDE_TIMES | IMP_FLAG_TURNS_EXACTLY;
    imp_code code =
        check_size(type->struct_size, MAP_TYPE_FIRST, &type->name, type->flags, flags, error);
    if (code != IMP_SUCCESS) return code;
    type_view view = type_view_of_map(type);
    const char *null_callback = type->create == NULL        ? "create"
                                : type->destroy == NULL     ? "destroy"
                                : type->time_domain == NULL ? "time_domain"
                                : type->eval == NULL        ? "eval"
                                : type->rate == NULL        ? "rate"
                                                            : NULL;
    return check_view(&view, null_callback, error);
}

/* --- The factories ---------------------------------------------------------------------------- */

static imp_code check_factory(const char *id, uint32_t size, uint32_t count, const void *types,
                              imp_error *error)
{
    if (size >= sizeof(imp_surface_factory) && count >= 1 && count <= TYPES_MAX && types != NULL)
        return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_PLUGIN,
                     "factory %s: struct_size is %u, must be >= %zu; count is %u, must be 1 to %u; "
                     "types %s",
                     id, size, sizeof(imp_surface_factory), count, TYPES_MAX,
                     types != NULL ? "is given" : "is NULL");
}

static imp_code null_type(const char *id, uint32_t index, imp_error *error)
{
    return error_set(error, IMP_ERROR_PLUGIN, "factory %s: type %u is NULL", id, index);
}

static imp_code twice(const char *id, const char *name, imp_error *error)
{
    return error_set(error, IMP_ERROR_PLUGIN, "factory %s: '%s' is listed twice", id, name);
}

static imp_code check_surfaces(const imp_surface_factory *f, imp_error *error)
{
    const char *id = IMP_SURFACE_FACTORY;
    imp_code code = check_factory(id, f->struct_size, f->count, f->types, error);
    for (uint32_t i = 0; code == IMP_SUCCESS && i < f->count; ++i) {
        if (f->types[i] == NULL) return null_type(id, i, error);
        code = check_surface(f->types[i], error);
        for (uint32_t k = 0; code == IMP_SUCCESS && k < i; ++k)
            if (strcmp(f->types[k]->name, f->types[i]->name) == 0)
                code = twice(id, f->types[i]->name, error);
    }
    return code;
}

static imp_code check_maps(const imp_map_factory *f, imp_error *error)
{
    const char *id = IMP_MAP_FACTORY;
    imp_code code = check_factory(id, f->struct_size, f->count, f->types, error);
    for (uint32_t i = 0; code == IMP_SUCCESS && i < f->count; ++i) {
        if (f->types[i] == NULL) return null_type(id, i, error);
        code = check_map(f->types[i], error);
        for (uint32_t k = 0; code == IMP_SUCCESS && k < i; ++k)
            if (strcmp(f->types[k]->name, f->types[i]->name) == 0)
                code = twice(id, f->types[i]->name, error);
    }
    return code;
}

imp_code plugin_check_factories(const imp_surface_factory *surfaces, const imp_map_factory *maps,
                                imp_error *error)
{
    if (surfaces == NULL && maps == NULL)
        return error_set(error, IMP_ERROR_PLUGIN,
                         "get_factory knows neither %s nor %s, so it offers no types",
                         IMP_SURFACE_FACTORY, IMP_MAP_FACTORY);
    imp_code code = surfaces != NULL ? check_surfaces(surfaces, error) : IMP_SUCCESS;
    if (code == IMP_SUCCESS && maps != NULL) code = check_maps(maps, error);
    return code;
}
