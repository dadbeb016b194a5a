/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_KEYS_H
#define PLUGINS_COMMON_KEYS_H

#include <impinge/plugin.h>

/* Checks of the lists of keys of a motion. `row`: the parameter's, for the error message. */

/* Checks that there are two or more keys, in increasing order. */
imp_status keys_check_times(int row, const imp_value *times, imp_create_error *why);

/* Checks that quaternions have lengths of 1 within 1e-6. */
imp_status keys_check_rotations(int row, const imp_value *rotations, imp_create_error *why);

#endif
