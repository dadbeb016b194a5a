/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_PLUGIN_CHECK_H
#define CORE_PLUGIN_PLUGIN_CHECK_H

#include "core/base/status.h"
#include "core/plugin/elf_probe.h"

/* Checks that a plugin's entry and tables keep the ABI
 * ===================================================
 * After loading and before use, everything is checked that can be checked without creating an
 * instance: the entry, its agreement with the note, the factories, each type, each row of
 * each parameter table, each default. One fault refuses the whole plugin.
 *
 * Errors name the type and parameter, what was found and what is allowed; the file is for the
 * caller to add. The code is IMP_ERROR_PLUGIN, or IMP_ERROR_MEMORY if memory ran out. */

/* The entry by itself and against the note found in the file; NULL: it comes from no file. */
imp_code plugin_check_entry(const imp_plugin *entry, const elf_probe *note, imp_error *error);

/* The factories the entry answered; either may be NULL, not both. */
imp_code plugin_check_factories(const imp_surface_factory *surfaces, const imp_map_factory *maps,
                                imp_error *error);

#endif
