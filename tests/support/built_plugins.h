/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_BUILT_PLUGINS_H
#define TESTS_SUPPORT_BUILT_PLUGINS_H

#include "core/plugin/registry.h"
#include "tests/support/suite.h"

/* The registry of the plugins in the build tree, and of no others. */
static inline imp_registry *built_registry(void)
{
    search_path path = {0};
    const char *top = getenv("top_builddir");
    char directory[4096];
    snprintf(directory, sizeof directory, "%s/plugins/.libs", top != NULL ? top : ".");
    ck_assert(search_path_add(&path, directory, true));
    imp_registry *registry = registry_scan(&path, 0);
    search_path_clear(&path);
    ck_assert_ptr_nonnull(registry);
    return registry;
}

#endif
