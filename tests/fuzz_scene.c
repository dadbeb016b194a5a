/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "registry.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whatever bytes a scene or a pipeline is made of, it is read or refused. `make check` runs this on
 * the files of tests/fuzz_scene.d, or on those named; to search for more, with clang and the
 * sources of core:
 *
 *     clang -fsanitize=fuzzer,address,undefined -DIMPINGE_LIBFUZZER ... tests/fuzz_scene.c
 *     top_builddir=. ./fuzz_scene tests/fuzz_scene.d                                       */

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length);

/* Our own plugins and those of the tests, from the folder of the build. */
static imp_registry *make_registry(void)
{
    const char *build = getenv("top_builddir");
    char list[4096];
    snprintf(list, sizeof list, "%s/plugins/.libs:%s/tests/plugins/.libs", build ? build : ".",
             build ? build : ".");
    search_path path = {.count = 0};
    imp_registry *registry = search_path_add(&path, list, false) ? registry_scan(&path, 0) : NULL;
    search_path_clear(&path);
    if (!registry || !registry_find_surface(registry, "kit")) {
        fprintf(stderr, "no plugins in %s\n", list);
        exit(EXIT_FAILURE);
    }
    return registry;
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    static imp_registry *registry;
    if (!registry) registry = make_registry();
    imp_error error;
    imp_scene_free(imp_scene_from_json(registry, (const char *)bytes, length, "input", &error));
    char *line = strndup((const char *)bytes, length);
    if (!line) return 0;
    imp_scene_free(imp_scene_from_pair(registry, line, line, &error));
    free(line);
    return 0;
}

#ifndef IMPINGE_LIBFUZZER

static int run_file(const char *path)
{
    static unsigned char bytes[1 << 20];
    FILE *file = fopen(path, "rb");
    if (!file) {
        perror(path);
        return EXIT_FAILURE;
    }
    size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    /* a block of just this size, so that a sanitizer sees a read past it */
    unsigned char *exact = malloc(length ? length : 1);
    if (!exact) return EXIT_FAILURE;
    memcpy(exact, bytes, length);
    LLVMFuzzerTestOneInput(exact, length);
    free(exact);
    return EXIT_SUCCESS;
}

static int run_corpus(void)
{
    const char *source = getenv("top_srcdir");
    char folder[2048], path[4096];
    snprintf(folder, sizeof folder, "%s/tests/fuzz_scene.d", source ? source : ".");
    DIR *stream = opendir(folder);
    if (!stream) {
        perror(folder);
        return EXIT_FAILURE;
    }
    int worst = EXIT_SUCCESS, count = 0;
    for (struct dirent *entry; (entry = readdir(stream)) != NULL;) {
        if (entry->d_name[0] == '.') continue;
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (run_file(path) != EXIT_SUCCESS) worst = EXIT_FAILURE;
        ++count;
    }
    closedir(stream);
    if (count == 0) worst = EXIT_FAILURE;
    printf("%s 1 the %d inputs of the corpus do no harm\n",
           worst == EXIT_SUCCESS ? "ok" : "not ok", count); /* TAP, as tools/test counts */
    return worst;
}

int main(int count, char **argument)
{
    if (count < 2) return run_corpus();
    int worst = EXIT_SUCCESS;
    for (int i = 1; i < count; ++i)
        if (run_file(argument[i]) != EXIT_SUCCESS) worst = EXIT_FAILURE;
    return worst;
}

#endif
