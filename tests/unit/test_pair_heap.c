/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_heap.h"
#include "tests/support/suite.h"

static pair random_pair(uint64_t *state, uint64_t serial)
{
    /* few distinct keys, so that ties are common */
    const double first = floor(random_between(state, 0, 8));
    return (pair){.key = {first, floor(random_between(state, 0, 4))}, .serial = serial};
}

static bool in_order(const pair *p, const pair *q)
{
    if (p->key[0] != q->key[0]) return p->key[0] < q->key[0];
    if (p->key[1] != q->key[1]) return p->key[1] < q->key[1];
    return p->serial < q->serial;
}

START_TEST(pairs_leave_by_both_keys_then_serial_number)
{
    uint64_t state = suite_seed();
    pair_heap heap = {0};
    for (uint64_t k = 0; k < 5000; ++k) {
        const pair p = random_pair(&state, k);
        ck_assert(pair_heap_reserve(&heap, 1));
        pair_heap_push(&heap, &p);
    }
    pair before = pair_heap_pop(&heap);
    for (size_t left = 4999; left > 0; --left) {
        ck_assert_uint_eq(heap.count, left);
        const pair next = pair_heap_pop(&heap);
        ck_assert(in_order(&before, &next));
        before = next;
    }
    pair_heap_clear(&heap);
}
END_TEST

START_TEST(the_top_is_what_pop_gives_with_pushes_in_between)
{
    uint64_t state = suite_seed();
    pair_heap heap = {0};
    uint64_t serial = 0, popped = 0;
    for (int k = 0; k < 20000; ++k) {
        if (heap.count == 0 || random_bits(&state) % 3 != 0) {
            const pair p = random_pair(&state, serial++);
            ck_assert(pair_heap_reserve(&heap, 1));
            pair_heap_push(&heap, &p);
            continue;
        }
        const pair top = pair_heap_at(&heap, 0);
        ck_assert(pair_heap_first(&heap) == top.key[0]);
        ck_assert_uint_eq(pair_heap_pop(&heap).serial, top.serial);
        size_t earlier = 0; /* counted: twenty million ck_asserts take minutes */
        for (size_t i = 0; i < heap.count; ++i) {
            const pair other = pair_heap_at(&heap, i);
            earlier += !in_order(&top, &other);
        }
        ck_assert_uint_eq(earlier, 0);
        ++popped;
    }
    ck_assert_uint_eq(heap.count + popped, serial);
    pair_heap_clear(&heap);
}
END_TEST

SUITE_MAIN("pair_heap", pairs_leave_by_both_keys_then_serial_number,
           the_top_is_what_pop_gives_with_pushes_in_between)
