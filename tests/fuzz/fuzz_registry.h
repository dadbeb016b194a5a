/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_FUZZ_REGISTRY_H
#define TESTS_FUZZ_FUZZ_REGISTRY_H

#include "core/plugin/registry.h"
#include "tests/fuzz/fuzz.h"

/* Plugins of the build; with those of the tests, some of which lie, for reading only. */
static inline imp_registry *fuzz_registry(bool with_tests)
{
    char list[8200], ours[4096], tests[4096];
    fuzz_path(ours, sizeof ours, "top_builddir", "plugins/.libs");
    fuzz_path(tests, sizeof tests, "top_builddir", "tests/plugins/.libs");
    snprintf(list, sizeof list, "%s%s%s", ours, with_tests ? ":" : "", with_tests ? tests : "");
    search_path path = {.count = 0};
    imp_registry *registry = search_path_add(&path, list, false) ? registry_scan(&path, 0) : NULL;
    search_path_clear(&path);
    if (registry == NULL ||
        registry_find_surface(registry, with_tests ? "kit" : "sphere") == NULL) {
        fprintf(stderr, "no plugins in %s\n", list);
        exit(EXIT_FAILURE);
    }
    return registry;
}

#endif
