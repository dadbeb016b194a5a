/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PARAMETERS_INTERNAL_H
#define CORE_PLUGIN_PARAMETERS_INTERNAL_H

#include "core/plugin/parameters.h"

/* What parameters.c, which reads JSON, parameter_value.c, which reads one value of it, and
 * parameter_numbers.c and parameter_default.c, which read none, share. */

/* Whether the row's kind and range allow the number. */
bool parameter_is_allowed(const imp_parameter *row, double x);

/* Reads the value of a parameter that is not given: its default, none, or an error at `at`. */
imp_code parameters_read_absent(const imp_parameter *row, const place *at, parameter_values *values,
                                imp_value *value, imp_error *error);

/* Reads a default that is a number, a short list of numbers, true, false or a string without
 * escapes. *is_plain: whether it is; else parameters_read_default reads it. IMP_ERROR_MEMORY, or
 * IMP_SUCCESS. */
imp_code parameter_default_plain(const imp_parameter *row, parameter_values *values,
                                 imp_value *value, bool *is_plain, imp_error *error);

/* Begins values of `count` rows, none of which is read, with room for so many numbers of defaults.
 * parameters_clear frees them, also on failure. IMP_ERROR_MEMORY, or IMP_SUCCESS. */
imp_code parameters_begin(parameter_values *values, size_t count, size_t room, arena_store *store,
                          imp_error *error);

/* Takes over JSON that `values` point into; NULL: it could not be made. IMP_ERROR_MEMORY, or
 * IMP_SUCCESS. */
imp_code parameters_keep(parameter_values *values, json_t *json, imp_error *error);

#endif
