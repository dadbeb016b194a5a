/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PLUGIN_CHECK_ROW_H
#define CORE_PLUGIN_PLUGIN_CHECK_ROW_H

#include "core/plugin/parameters.h"

/* Checks one row of a type's parameter table: its texts, kind, flags, range and default, and that
 * its name is not listed twice. `type` is where errors begin. */
imp_code plugin_check_row(const parameter_table *table, size_t index, const place *type,
                          imp_error *error);

#endif
