/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_READER_REQUIRED_PLUGINS_H
#define CORE_READER_REQUIRED_PLUGINS_H

#include <jansson.h>

#include "core/base/place.h"

/* Versions of plugins that a scene requires
 * =========================================
 *
 *     "plugins": { "gear": ">= 0.2", "cam": ">= 1.3, < 2" }
 *
 * Each key is the name of a plugin (`plugin` of imp_type_info) one of whose types is in force; each
 * value is one comparison of its version or several, all of which must hold. Versions are compared
 * number by number, numbers that are missing being 0; one with letters behind them, as 1.0-rc2,
 * comes before the one without. */

/* Checks the scene's key "plugins", if it is there. `root` stands at `at`. */
imp_code required_plugins_check(const imp_registry *registry, const json_t *root, const place *at,
                                imp_error *error);

/* Returns a number below, equal to or above 0: version x comes before y, is it, comes after it. */
int required_plugins_compare(const char *x, const char *y);

#endif
