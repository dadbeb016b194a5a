/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tests/fuzz/fuzz.h"
#include "tools/verify/tighten.h"

/* Whatever bytes a certificate holds, the verifier ends with an answer: it holds, or why not. The
 * checksum that belongs to the bytes is added, since hardly any change would get past it. What it
 * tightens of one that holds is no longer, and holds. */

const char fuzz_target[] = "certificate";

/* Tests of a leaf; of one that was tightened, which other leaves before it may cost some. */
enum { EFFORT = 2, EFFORT_TIGHTENED = 1000 };

/* Returns whether it holds. `to` takes a shorter one; NULL: none is written. */
static bool verify(const unsigned char *bytes, size_t size, unsigned long effort, FILE *to)
{
    FILE *file = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    if (file == NULL) return false;
    input in;
    statement says;
    uint64_t leaves;
    input_begin(&in, file);
    walk w = {.in = &in, .says = &says, .effort = effort, .shares = 1};
    tightening *g = to != NULL ? tighten_begin(&w, to) : NULL;
    bool good = statement_read(&says, &in);
    w.assumed = calloc(says.stage_count + 1, sizeof *w.assumed);
    good = good && w.assumed != NULL && walk_points(&w) && walk_trees(&w);
    FUZZ_REQUIRE(good != input_is_refused(&in));
    FUZZ_REQUIRE(in.fault_at <= size);
    if (g != NULL) FUZZ_REQUIRE(tighten_end(g, &leaves) && (!good || leaves <= w.leaves));
    tighten_free(g);
    statement_free(&says);
    free(w.assumed);
    fclose(file);
    return good;
}

static void tighten(const unsigned char *bytes, size_t size)
{
    char *shorter = NULL;
    size_t length = 0;
    FILE *to = open_memstream(&shorter, &length);
    if (to == NULL) return;
    const bool good = verify(bytes, size, EFFORT, to);
    fclose(to);
    if (good) {
        FUZZ_REQUIRE(length <= size);
        FUZZ_REQUIRE(verify((const unsigned char *)shorter, length, EFFORT_TIGHTENED, NULL));
    }
    free(shorter);
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
    tighten(all, length + SHA256_BYTES);
    if (length > 0) verify(all, length, EFFORT, NULL);
    free(all);
    return 0;
}
