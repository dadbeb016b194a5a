/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PARAMETERS_H
#define CORE_PLUGIN_PARAMETERS_H

#include <jansson.h>

#include "core/base/arena_store.h"
#include "core/base/named_files.h"
#include "core/base/place.h"
#include "core/plugin/array_file.h"
#include "core/plugin/parameter_table.h"

/* From a JSON object to the values a type is created from
 * =======================================================
 * The object has the type's parameters by name, beside "type" and "maps". Everything a
 * parameter table can say is checked here: kind, shape, range, finiteness, what is missing
 * and what is unknown. A type's create checks only what the table cannot say.
 *
 * JSON numbers are expected as reals, whole ones too (JSON_DECODE_INT_AS_REAL): the text then
 * may have numbers of any length, and IMP_KIND_INTEGER takes 3.0 for 3. */

#define PARAMETERS_JSON_FLAGS (JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL)

/* Keys of the object that are never parameters, so no parameter may be called so. */
bool parameters_is_reserved(const char *name);

/* One value per row, in its order. Strings and names point into the JSON they were read
 * from, which must live as long. */
typedef struct parameter_values {
    imp_value *value;
    bool *given; /* of each row: the object has it */
    size_t count;
    bool borrows;        /* the numbers that were given are the caller's */
    double *room;        /* numbers of defaults, in the memory of `value`; NULL: none are there */
    size_t room_left;    /* numbers that still fit there */
    arena_store *store;  /* of that memory */
    named_files files;   /* array files that were read */
    uint64_t file_bytes; /* of their numbers */
    json_t *made; /* JSON that is not in the object: presets, names of files made whole; or NULL */
} parameter_values;

/* Reads the parameters of the type called `type` from `object`, which is at `at`. Relative names of
 * files (IMP_PARAMETER_FILE, array_file.h) begin at `folder`, which ends in '/', or if it is NULL
 * where the process does. On failure there is nothing to clear. */
imp_code parameters_read(const parameter_table *table, const char *type, const json_t *object,
                         const char *folder, const array_file_limit *limit, const place *at,
                         parameter_values *values, imp_error *error);

void parameters_clear(parameter_values *values);

/* The value of one parameter; owns its arrays. parameters_read reads each so, and the registry a
 * row's default. */
imp_code parameters_read_value(const imp_parameter *row, const json_t *json, const place *at,
                               imp_value *value, imp_error *error);
void parameters_clear_value(imp_value *value);

/* Parses a row's default; the caller owns *json. */
imp_code parameters_read_default(const imp_parameter *row, const place *at, json_t **json,
                                 imp_error *error);

/* What create complained about, as an error with its place. Texts of plugins are not trusted. */
imp_code parameters_create_error(const parameter_table *table, const parameter_values *values,
                                 const imp_create_error *why, const place *at, imp_error *error);

#endif
