/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/catalogue.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "tools/cli/output.h"

const char *catalogue_kind_name(imp_type_kind kind)
{
    return kind == IMP_TYPE_SURFACE ? "surface" : "map";
}

const imp_parameter *catalogue_parameter(const imp_type_info *info, size_t index)
{
    const char *table = (const char *)info->parameters;
    return (const imp_parameter *)(const void *)(table + index * info->parameter_size);
}

static const char *kind_name(imp_kind kind)
{
    switch (kind) {
    case IMP_KIND_NUMBER:
        return "number";
    case IMP_KIND_INTEGER:
        return "integer";
    case IMP_KIND_BOOLEAN:
        return "boolean";
    case IMP_KIND_STRING:
        return "string";
    case IMP_KIND_TABLE:
        return "table";
    default:
        return "value";
    }
}

/* From the innermost extent outward: "number" -> "vector of 3 numbers" -> "list of vectors of ...".
 * `s` is how the plural of what stands inside begins. */
shape_text catalogue_shape(const imp_parameter *p)
{
    shape_text shape, inner;
    const uint32_t rank = p->rank < IMP_RANK_MAX ? p->rank : IMP_RANK_MAX;
    if (p->kind == IMP_KIND_TABLE)
        snprintf(shape.text, sizeof shape.text, "table of names to numbers");
    else
        snprintf(shape.text, sizeof shape.text, "%s", kind_name(p->kind));
    for (uint32_t k = rank; k-- > 0;) {
        const char *word = k + 1 == rank && p->extent[k] > 0 ? "vector" : "list";
        char count[16] = "";
        inner = shape;
        if (p->extent[k] > 0) snprintf(count, sizeof count, "%u ", (unsigned)p->extent[k]);
        const char *head = inner.text, *tail = strstr(inner.text, " of ");
        const int head_length = tail != NULL ? (int)(tail - head) : (int)strlen(head);
        snprintf(shape.text, sizeof shape.text, "%s of %s%.*ss%.100s", word, count, head_length,
                 head, tail != NULL ? tail : "");
    }
    return shape;
}

range_text catalogue_range(const imp_parameter *p)
{
    range_text range = {""};
    const bool low = isfinite(p->min), high = isfinite(p->max);
    const char *above = p->flags & IMP_PARAMETER_MIN_OPEN ? ">" : ">=";
    const char *below = p->flags & IMP_PARAMETER_MAX_OPEN ? "<" : "<=";
    if (p->kind != IMP_KIND_NUMBER && p->kind != IMP_KIND_INTEGER) return range;
    if (low && high && !(p->flags & (IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_MAX_OPEN)))
        snprintf(range.text, sizeof range.text, "from %.10g to %.10g", p->min, p->max);
    else if (low && high)
        snprintf(range.text, sizeof range.text, "%s %.10g and %s %.10g", above, p->min, below,
                 p->max);
    else if (low)
        snprintf(range.text, sizeof range.text, "%s %.10g", above, p->min);
    else if (high)
        snprintf(range.text, sizeof range.text, "%s %.10g", below, p->max);
    return range;
}

static json_t *capabilities_json(const imp_type_info *info)
{
    json_t *names = json_array();
    for (const char *name = info->capabilities; *name != '\0';) {
        const size_t length = strcspn(name, " ");
        json_array_append_new(names, json_stringn(name, length));
        name += length + (name[length] == ' ');
    }
    return names;
}

json_t *catalogue_short_json(const imp_type_info *info)
{
    return json_pack(
        "{s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "kind", catalogue_kind_name(info->kind), "name",
        output_json_text(info->name), "summary", output_json_text(info->summary), "file",
        output_json_text(info->file), "shadowed_by", output_json_text(info->shadowed_by), "plugin",
        output_json_text(info->plugin), "version", output_json_text(info->version), "capabilities",
        capabilities_json(info));
}

/* Returns the extents, outermost first; null where any number is allowed. */
static json_t *extents_json(const imp_parameter *p)
{
    json_t *extents = json_array();
    for (uint32_t k = 0; k < p->rank && k < IMP_RANK_MAX; ++k)
        json_array_append_new(extents, p->extent[k] > 0 ? json_integer(p->extent[k]) : json_null());
    return extents;
}

/* The default is JSON text in the plugin's table. */
static json_t *default_json(const imp_parameter *p)
{
    json_t *preset =
        p->default_value != NULL ? json_loads(p->default_value, JSON_DECODE_ANY, NULL) : NULL;
    return preset != NULL ? preset : json_null();
}

static json_t *parameter_json(const imp_parameter *p)
{
    return json_pack("{s:o, s:s, s:o, s:b, s:b, s:o, s:o, s:b, s:o, s:b, s:o, s:o}", "name",
                     output_json_text(p->name), "kind", kind_name(p->kind), "shape",
                     extents_json(p), "scalar_ok", (p->flags & IMP_PARAMETER_SCALAR_OK) != 0,
                     "required",
                     p->default_value == NULL && (p->flags & IMP_PARAMETER_OPTIONAL) == 0,
                     "default", default_json(p), "min", output_json_number(p->min), "min_open",
                     (p->flags & IMP_PARAMETER_MIN_OPEN) != 0, "max", output_json_number(p->max),
                     "max_open", (p->flags & IMP_PARAMETER_MAX_OPEN) != 0, "unit",
                     output_json_text(p->unit), "doc", output_json_text(p->doc));
}

static json_t *parameters_json(const imp_type_info *info)
{
    json_t *rows = json_array();
    for (size_t i = 0; i < info->parameter_count; ++i)
        if (json_array_append_new(rows, parameter_json(catalogue_parameter(info, i))) != 0) {
            json_decref(rows);
            return NULL;
        }
    return rows;
}

json_t *catalogue_full_json(const imp_type_info *info)
{
    json_t *type = catalogue_short_json(info);
    json_t *more = json_pack(
        "{s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "equation", output_json_text(info->equation),
        "formula", output_json_text(info->formula), "source", output_json_text(info->source),
        "parameters", parameters_json(info), "example", output_json_text(info->example), "license",
        output_json_text(info->license), "author", output_json_text(info->author));
    if (type == NULL || more == NULL || json_object_update(type, more) != 0) {
        json_decref(type);
        type = NULL;
    }
    json_decref(more);
    return type;
}
