/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_KIT_REGISTRY_H
#define TESTS_SUPPORT_KIT_REGISTRY_H

#include "core/plugin/registry.h"
#include "tests/support/sandbox.h"

/* The types of tests/plugins/kit.c and of those plugins whose create misbehaves, and no others. */
static inline imp_registry *kit_registry(void)
{
    static const char *const plugins[] = {"create_fails", "create_null", "create_rounds", "kit"};
    sandbox box = sandbox_new();
    for (size_t i = 0; i < sizeof plugins / sizeof *plugins; ++i) {
        char name[100];
        snprintf(name, sizeof name, "%s.so", plugins[i]);
        sandbox_link(&box, plugins[i], name);
    }
    search_path path = {.count = 0};
    ck_assert(search_path_add(&path, box.path, true));
    imp_registry *registry = registry_scan(&path, 0);
    ck_assert_ptr_nonnull(registry);
    search_path_clear(&path);
    sandbox_remove(&box);
    return registry;
}

#endif
