/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_FUZZ_H
#define TESTS_FUZZ_FUZZ_H

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* Fuzz targets
 * ============
 * Each target is one file with LLVMFuzzerTestOneInput and fuzz_target. `make check` links it with
 * replay.c, which runs it on the files of tests/fuzz/NAME.d; tests/fuzz/run builds it with clang's
 * libFuzzer and searches for more. A target aborts when what it checks does not hold. */

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length);

extern const char fuzz_target[]; /* its name, that of the folder of inputs */

/* In the folder of the build ($top_builddir), or of the sources ($top_srcdir). */
static inline void fuzz_path(char *to, size_t size, const char *variable, const char *below)
{
    const char *top = getenv(variable);
    snprintf(to, size, "%s/%s", top != NULL ? top : ".", below);
}

/* Ends the process with the place, for libFuzzer and for replay.c. */
#define FUZZ_REQUIRE(CONDITION)                                                                    \
    do {                                                                                           \
        if (!(CONDITION)) {                                                                        \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #CONDITION);                \
            abort();                                                                               \
        }                                                                                          \
    } while (0)

#endif
