/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_FAILING_QUERY_H
#define TESTS_SUPPORT_FAILING_QUERY_H

#include "tests/support/alloc_failure.h"
#include "tests/support/query_helpers.h"

/* A query of two surfaces in which each allocation fails once, and that goes on when there is
 * memory. */
typedef struct failing_query {
    imp_registry *registry;
    const char *a, *b; /* pipelines */
    imp_verdict verdict;
    uint64_t pairs_most;
} failing_query;

/* The n-th allocation fails; 0: none does. True: it was reached. */
static inline bool failing_query_at(const failing_query *q, size_t n)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(q->registry, q->a, q->b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    const imp_options options = imp_options_default(scene);
    imp_code code = IMP_SUCCESS;
    alloc_failure_begin(n);
    imp_query *query = imp_query_new(scene, &options, &error);
    if (query != NULL) code = imp_query_step(query, 0, &error);
    const bool failed = alloc_failure_end() && n > 0;
    ck_assert_int_eq(code, IMP_SUCCESS);
    ck_assert(query != NULL || error.code == IMP_ERROR_MEMORY);
    if (query != NULL) {
        const imp_result r = imp_query_result(query);
        ck_assert_msg((r.reason == IMP_REASON_MEMORY) == failed, "failing allocation %zu: %d, %d",
                      n, (int)r.verdict, (int)r.reason);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_query_result(query).verdict, q->verdict);
        ck_assert_uint_le(imp_query_result(query).stats.pairs, q->pairs_most);
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return failed;
}

/* Fails each allocation in turn: nothing is left behind. */
static inline void failing_query_try_all(const failing_query *q)
{
    ck_assert(!failing_query_at(q, 0)); /* what the registry keeps for later is there then */
    const size_t before = alloc_failure_live();
    size_t n = 0;
    for (bool failed = true; failed && n < 10000;) {
        failed = failing_query_at(q, ++n);
        ck_assert_msg(alloc_failure_live() == before, "failing allocation %zu leaves %zd blocks", n,
                      (ssize_t)(alloc_failure_live() - before));
    }
    ck_assert_uint_gt(n, 4);
}

#endif
