/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_FUZZ_FILE_H
#define TESTS_FUZZ_FUZZ_FILE_H

#include <stdbool.h>
#include <unistd.h>

#include "tests/fuzz/fuzz.h"

/* The file of a target that reads files: one for the whole process, which removes it at its end. */
static char fuzz_file[] = "/tmp/impinge-fuzz-XXXXXX";

static void fuzz_file_remove(void) { unlink(fuzz_file); }

static inline void fuzz_file_write(const unsigned char *bytes, size_t length)
{
    static bool prepared;
    if (!prepared) {
        const int fd = mkstemp(fuzz_file);
        FUZZ_REQUIRE(fd >= 0);
        close(fd);
        atexit(fuzz_file_remove);
        prepared = true;
    }
    FILE *out = fopen(fuzz_file, "wb");
    FUZZ_REQUIRE(out != NULL && fwrite(bytes, 1, length, out) == length && fclose(out) == 0);
}

#endif
