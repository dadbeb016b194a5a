/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tests/fuzz/fuzz.h"
#include "tools/kernel/kernel.h"
#include "tools/verify/elaborate.h"

/* Whatever bytes a certificate holds, the kernel ends with an answer; what is elaborated of one, it
 * accepts. */

const char fuzz_target[] = "kernel";

enum { CHECKSUM = 32, EFFORT = 20 };

static bool judge(const unsigned char *from, size_t size)
{
    FILE *file = fmemopen((void *)(uintptr_t)from, size, "rb");
    if (file == NULL) return false;
    bytes in = {.file = file};
    claim c;
    trees w = {.in = &in, .of = &c};
    const bool good = claim_read(&c, &in) && trees_hold(&w);
    FUZZ_REQUIRE(good == bytes_are_good(&in));
    FUZZ_REQUIRE(in.at <= size);
    claim_free(&c);
    fclose(file);
    return good;
}

static void elaborate_and_judge(const unsigned char *from, size_t size)
{
    char *made = NULL;
    size_t length = 0;
    elaborated found;
    FILE *file = fmemopen((void *)(uintptr_t)from, size, "rb"),
         *to = open_memstream(&made, &length);
    const bool good = file != NULL && to != NULL && elaborate(file, to, EFFORT, NULL, &found);
    if (file != NULL) fclose(file);
    if (to != NULL) fclose(to);
    if (good) FUZZ_REQUIRE(judge((const unsigned char *)made, length));
    free(made);
}

int LLVMFuzzerTestOneInput(const unsigned char *from, size_t length)
{
    unsigned char *all = calloc(1, length + CHECKSUM);
    if (all == NULL) return 0;
    memcpy(all, from, length);
    judge(all, length + CHECKSUM);
    elaborate_and_judge(all, length + CHECKSUM);
    free(all);
    return 0;
}
