/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/allocations.h"

#include "tools/check/calls.h"
#include "tools/check/malloc_watch.h"

enum { ROUNDS = 64 };

void allocations_check(const subject *s, uint64_t *random, double effort)
{
    (void)effort;
    if (!malloc_watch_begin()) {
        answer_skip(s->answer, "calls of malloc cannot be watched on this system");
        return;
    }
    for (int k = 0; k < ROUNDS; ++k)
        for (size_t which = 0; which < PURE_CALLS; ++which) {
            malloc_watch_start();
            pure_call(s, which, random);
            const char *name = malloc_watch_stop();
            ++s->answer->tests;
            if (name == NULL) continue;
            answer_fail(s->answer,
                        "%s calls %s: it must not allocate or free, because many threads call it "
                        "at once, and a search many million times",
                        pure_call_name(s, which), name);
            return;
        }
    answer_pass(s->answer, "no callback allocates or frees memory");
}
