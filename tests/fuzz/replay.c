/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/fuzz.h"

#include <dirent.h>
#include <string.h>

/* Runs a target on the files named, or on all of its folder. */

static int run_file(const char *path)
{
    static unsigned char bytes[1 << 20];
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return EXIT_FAILURE;
    }
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    /* a block of just this size, so that a sanitizer sees a read past it */
    unsigned char *exact = malloc(length > 0 ? length : 1);
    if (exact == NULL) return EXIT_FAILURE;
    memcpy(exact, bytes, length);
    LLVMFuzzerTestOneInput(exact, length);
    free(exact);
    return EXIT_SUCCESS;
}

static int run_corpus(void)
{
    char folder[2048], name[64], path[4096];
    snprintf(name, sizeof name, "tests/fuzz/%s.d", fuzz_target);
    fuzz_path(folder, sizeof folder, "top_srcdir", name);
    DIR *stream = opendir(folder);
    if (stream == NULL) {
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
    printf("%s 1 the %d inputs of the corpus do no harm\n", worst == EXIT_SUCCESS ? "ok" : "not ok",
           count); /* TAP, as tools/test counts */
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
