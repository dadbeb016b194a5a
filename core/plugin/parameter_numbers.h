/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PARAMETER_NUMBERS_H
#define CORE_PLUGIN_PARAMETER_NUMBERS_H

#include <impinge/impinge.h>

#include "core/plugin/parameters.h"

/* Reads arguments that are all numbers, without JSON between: the values are those that
 * parameters_read reads from an object of the same numbers. values->value NULL: an argument is of
 * another kind, unknown, given twice, or not as its row says, or one is missing. parameters_read
 * then says what is wrong, or reads it. The values point into the arguments, and take their memory
 * from the store, which may be NULL. IMP_SUCCESS, or IMP_ERROR_MEMORY; on failure there is nothing
 * to clear. */
imp_code parameter_numbers_read(const parameter_table *table, const imp_argument *arguments,
                                size_t count, arena_store *store, const place *at,
                                parameter_values *values, imp_error *error);

/* Returns how many numbers the argument has, which parameter_numbers_read has read. */
size_t parameter_numbers_count(const imp_argument *a);

#endif
