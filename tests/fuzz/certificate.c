/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tests/fuzz/fuzz.h"
#include "tools/verify/walk.h"

/* Whatever bytes a certificate holds, the verifier ends with an answer: it holds, or why not. The
 * checksum that belongs to the bytes is added, since hardly any change would get past it. */

const char fuzz_target[] = "certificate";

enum { EFFORT = 2 };

static void verify(const unsigned char *bytes, size_t size)
{
    FILE *file = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    if (file == NULL) return;
    input in;
    statement says;
    input_begin(&in, file);
    walk w = {.in = &in, .says = &says, .effort = EFFORT, .shares = 1};
    bool good = statement_read(&says, &in);
    w.assumed = calloc(says.stage_count + 1, sizeof *w.assumed);
    good = good && w.assumed != NULL && walk_points(&w) && walk_trees(&w);
    FUZZ_REQUIRE(good != input_is_refused(&in));
    FUZZ_REQUIRE(in.fault_at <= size);
    statement_free(&says);
    free(w.assumed);
    fclose(file);
}

int LLVMFuzzerTestOneInput(const unsigned char *bytes, size_t length)
{
    unsigned char *all = malloc(length + SHA256_BYTES);
    sha256 h;
    if (all == NULL) return 0;
    memcpy(all, bytes, length);
    sha256_begin(&h);
    sha256_add(&h, all, length);
    sha256_end(&h, all + length);
    verify(all, length + SHA256_BYTES);
    if (length > 0) verify(all, length);
    free(all);
    return 0;
}
