/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/parameter_table.h"

#include <impinge/impinge.h>

#include <assert.h>
#include <stdio.h>
#include <string.h>

const imp_parameter *parameter_table_row(const parameter_table *table, size_t index)
{
    assert(index < table->count);
    return (const imp_parameter *)((const char *)table->rows + index * table->stride);
}

ptrdiff_t parameter_table_find(const parameter_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; ++i)
        if (strcmp(parameter_table_row(table, i)->name, name) == 0) return (ptrdiff_t)i;
    return -1;
}

const char *parameter_table_nearest(const parameter_table *table, const char *name)
{
    spelling_search search = {.wanted = name};
    for (size_t i = 0; i < table->count; ++i)
        spelling_offer(&search, parameter_table_row(table, i)->name);
    return search.best;
}

parameter_words parameter_range_words(const imp_parameter *row)
{
    parameter_words words;
    bool above = row->flags & IMP_PARAMETER_MIN_OPEN, below = row->flags & IMP_PARAMETER_MAX_OPEN;
    text_number min = text_of_number(row->min), max = text_of_number(row->max);
    if (isfinite(row->min) && isfinite(row->max))
        snprintf(words.at, sizeof words.at, "in %s%s, %s%s", above ? "(" : "[", min.at, max.at,
                 below ? ")" : "]");
    else if (isfinite(row->min))
        snprintf(words.at, sizeof words.at, "%s %s", above ? ">" : ">=", min.at);
    else if (isfinite(row->max))
        snprintf(words.at, sizeof words.at, "%s %s", below ? "<" : "<=", max.at);
    else
        snprintf(words.at, sizeof words.at, "finite");
    return words;
}

static const char *kind_word(imp_kind kind, bool many)
{
    switch (kind) {
    case IMP_KIND_NUMBER:
        return many ? "numbers" : "a number";
    case IMP_KIND_INTEGER:
        return many ? "whole numbers" : "a whole number";
    case IMP_KIND_BOOLEAN:
        return many ? "booleans" : "true or false";
    case IMP_KIND_STRING:
        return many ? "strings" : "a string";
    default:
        return many ? "objects of numbers" : "an object of numbers";
    }
}

static bool has_range(const imp_parameter *row)
{
    bool counts = row->kind == IMP_KIND_NUMBER || row->kind == IMP_KIND_INTEGER ||
                  row->kind == IMP_KIND_TABLE;
    return counts && (isfinite(row->min) || isfinite(row->max));
}

parameter_words parameter_shape_words(const imp_parameter *row, uint32_t depth)
{
    parameter_words words = {""};
    char *text = words.at;
    for (uint32_t k = depth; k < row->rank; ++k) {
        text_append(text, sizeof words.at, "%s", k == depth ? "an array of " : "arrays of ");
        if (row->extent[k] > 0) text_append(text, sizeof words.at, "%u ", row->extent[k]);
    }
    text_append(text, sizeof words.at, "%s", kind_word(row->kind, depth < row->rank));
    if (has_range(row)) text_append(text, sizeof words.at, " %s", parameter_range_words(row).at);
    return words;
}

size_t parameter_name_length(const char *text)
{
    return strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_");
}
