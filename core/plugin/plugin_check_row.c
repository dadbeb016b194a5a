/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/text.h"
#include "core/plugin/plugin_check_row.h"

#define PARAMETER_FLAGS                                                                            \
    (IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_MAX_OPEN | IMP_PARAMETER_SCALAR_OK |                   \
     IMP_PARAMETER_OPTIONAL | IMP_PARAMETER_FILE)

static const char *row_texts_fault(const imp_parameter *row)
{
    if (!text_is_name(row->name, "_"))
        return "name: must be letters, digits and '_', a letter first";
    if (parameters_is_reserved(row->name)) return "name: is taken by the scene format";
    if (!text_is_line(row->unit)) return "unit: is not a line of text; give \"1\" if it has none";
    if (!text_is_line(row->doc)) return "doc: is not a line of text";
    return NULL;
}

static const char *row_shape_fault(const imp_parameter *row)
{
    if (row->kind < IMP_KIND_NUMBER || row->kind > IMP_KIND_TABLE) return "kind: is unknown";
    if (row->flags & ~(uint32_t)PARAMETER_FLAGS) return "flags: has unknown bits";
    if (row->rank > IMP_RANK_MAX) return "rank: is more than 3";
    if (row->kind == IMP_KIND_TABLE && row->rank != 0) return "rank: of a table must be 0";
    if (row->flags & IMP_PARAMETER_SCALAR_OK && (row->rank != 1 || row->extent[0] > 1))
        return "flags: IMP_PARAMETER_SCALAR_OK is for rank 1 with extent 0 or 1";
    if (row->flags & IMP_PARAMETER_OPTIONAL && row->default_value != NULL)
        return "flags: IMP_PARAMETER_OPTIONAL means absent when left out, so default_value must be "
               "NULL";
    if (row->flags & IMP_PARAMETER_FILE && (row->kind != IMP_KIND_STRING || row->rank != 0))
        return "flags: IMP_PARAMETER_FILE is for IMP_KIND_STRING of rank 0";
    return NULL;
}

static const char *row_range_fault(const imp_parameter *row)
{
    bool open = row->flags & (IMP_PARAMETER_MIN_OPEN | IMP_PARAMETER_MAX_OPEN);
    if (!(row->min <= row->max)) return "min, max: min must not exceed max, nor be NaN";
    if (row->min == row->max && (open || isinf(row->min))) return "min, max: no value is allowed";
    return NULL;
}

static imp_code check_default(const imp_parameter *row, const place *at, imp_error *error)
{
    if (row->default_value == NULL) return IMP_SUCCESS;
    place preset = place_key(at, "default_value");
    json_t *json;
    imp_code code = parameters_read_default(row, &preset, &json, error);
    if (code != IMP_SUCCESS) return code;
    imp_value value;
    code = parameters_read_value(row, json, &preset, &value, error);
    if (code == IMP_SUCCESS) parameters_clear_value(&value);
    json_decref(json);
    if (code != IMP_ERROR_SCENE) return code;
    if (error != NULL) error->code = IMP_ERROR_PLUGIN; /* the plugin's value, not a scene's */
    return IMP_ERROR_PLUGIN;
}

imp_code plugin_check_row(const parameter_table *table, size_t index, const place *type,
                          imp_error *error)
{
    const imp_parameter *row = parameter_table_row(table, index);
    place number = place_index(type, index);
    const char *what = row_texts_fault(row);
    if (what != NULL) return place_error(&number, error, IMP_ERROR_PLUGIN, "%s", what);
    place at = place_argument(type, row->name);
    what = row_shape_fault(row);
    if (what == NULL) what = row_range_fault(row);
    if (what == NULL && parameter_table_find(table, row->name) != (ptrdiff_t)index)
        what = "is listed twice in the parameter table";
    if (what != NULL) return place_error(&at, error, IMP_ERROR_PLUGIN, "%s", what);
    return check_default(row, &at, error);
}
