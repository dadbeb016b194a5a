/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MADE_CERTIFICATE_H
#define TESTS_SUPPORT_MADE_CERTIFICATE_H

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <mpfi.h>

#include "tests/support/made_texts.h"
#include "tests/support/suite.h"
#include "tools/verify/walk.h"

/* impinge-verify on certificates that are made here. */

enum { EFFORT = 200, EFFORT_OF_CHANGES = 24 };

static inline bool verify_bytes(const uint8_t *bytes, size_t size, unsigned long effort,
                                statement *s, char fault[1400], bool *assumes)
{
    FILE *file = fmemopen((void *)(uintptr_t)bytes, size, "rb");
    ck_assert_ptr_nonnull(file);
    input in;
    input_begin(&in, file);
    walk w = {.in = &in, .says = s, .effort = effort, .shares = 1};
    bool good = statement_read(s, &in);
    w.assumed = calloc(s->stage_count + 1, sizeof *w.assumed);
    good = good && walk_points(&w) && walk_trees(&w);
    *assumes = false;
    for (size_t k = 0; k < s->stage_count; ++k) *assumes = *assumes || w.assumed[k];
    memcpy(fault, in.fault, sizeof in.fault);
    free(w.assumed);
    fclose(file);
    return good;
}

/* Verifies with the checksum that belongs to the bytes. */
static inline bool verify(const certificate *c, unsigned long effort, statement *s,
                          char fault[1400], bool *assumes)
{
    uint8_t all[BYTES_MAX + SHA256_BYTES];
    sha256 h;
    memcpy(all, c->bytes, c->size);
    sha256_begin(&h);
    sha256_add(&h, all, c->size);
    sha256_end(&h, all + c->size);
    return verify_bytes(all, c->size + SHA256_BYTES, effort, s, fault, assumes);
}

/* Requires that the certificate holds, or (why not NULL) is refused in these words. */
static inline void require_within(const certificate *c, unsigned long effort, const char *why)
{
    statement s;
    char fault[1400];
    bool assumes;
    const bool good = verify(c, effort, &s, fault, &assumes);
    if (why == NULL) {
        ck_assert_msg(good && !assumes, "%s", fault);
    } else {
        ck_assert_msg(!good, "accepted: %s: %.*s", why, (int)c->size, (const char *)c->bytes);
        ck_assert_msg(strstr(fault, why) != NULL, "%s", fault);
    }
    statement_free(&s);
}

static inline void require(const certificate *c, const char *why)
{
    require_within(c, EFFORT, why);
}

#endif
