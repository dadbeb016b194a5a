/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_KEYS_H
#define PLUGINS_COMMON_KEYS_H

#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* Lists of the keys of a motion: their checks, a copy, their text. `row`: the parameter's, for the
 * error message. */

/* Checks that there are two or more keys, in increasing order. */
imp_status keys_check_times(int row, const imp_value *times, imp_create_error *why);

/* Checks that quaternions have lengths of 1 within 1e-6. */
imp_status keys_check_rotations(int row, const imp_value *rotations, imp_create_error *why);

/* Checks that the list of a row, if it is given, has as many entries as wanted. values[0] has the
 * times. */
imp_status keys_check_count(const imp_parameter *parameters, const imp_value *values, int row,
                            size_t wanted, imp_create_error *why);

/* Copies a list to *room and moves that behind it. NULL: the list was not given. */
const double *keys_keep(const imp_value *list, double **room);

/* Defines numbers of a list as NAME0, NAME1, ... in the text of a formula. */
void keys_define(const imp_text_sink *to, const char *name, const double *list, size_t count);

#endif
