/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pthread.h>
#include <string.h>

#include "core/base/arena.h"
#include "tests/support/suite.h"

static const arena_growth sizes = {256, 4, 4096};

START_TEST(rooms_lie_apart_and_keep_what_is_in_them)
{
    enum { ROOMS = 2000 };
    uint64_t state = suite_seed();
    arena a = {NULL};
    unsigned char *room[ROOMS];
    size_t length[ROOMS], made = 0;
    for (size_t k = 0; k < ROOMS; ++k) {
        length[k] = 8 * (1 + random_bits(&state) % 12);
        room[k] = arena_take(&a, &sizes, length[k], &made);
        ck_assert_ptr_nonnull(room[k]);
        ck_assert_uint_eq((uintptr_t)room[k] % sizeof(double), 0);
        memset(room[k], (int)(k % 251), length[k]);
    }
    size_t changed = 0;
    for (size_t k = 0; k < ROOMS; ++k)
        for (size_t i = 0; i < length[k]; ++i) changed += room[k][i] != k % 251;
    ck_assert_uint_eq(changed, 0);
    arena_clear(&a);
    ck_assert_ptr_null(arena_next(&a, 8));
}
END_TEST

START_TEST(blocks_grow_up_to_the_most_and_are_counted)
{
    arena a = {NULL};
    size_t made = 0, before = 0;
    const size_t capacity[] = {256, 1024, 4096, 4096};
    for (size_t k = 0; k < sizeof capacity / sizeof *capacity; ++k) {
        ck_assert_ptr_nonnull(arena_take(&a, &sizes, 128, &made));
        ck_assert_uint_eq(made - before, sizeof(arena_block) + capacity[k]);
        before = made;
        for (size_t used = 128; used < capacity[k]; used += 128)
            ck_assert_ptr_nonnull(arena_next(&a, 128));
        ck_assert_ptr_null(arena_next(&a, 8));
        ck_assert_uint_eq(made, before);
    }
    ck_assert_ptr_nonnull(arena_take(&a, &sizes, 8192, &made)); /* more than the most */
    ck_assert_uint_eq(made - before, sizeof(arena_block) + 8192);
    arena_clear(&a);
}
END_TEST

typedef struct sharing {
    arena *of;
    pthread_mutex_t *lock;
    uint64_t *taken[4000];
    uint64_t mark;
} sharing;

static void *take_many(void *of)
{
    sharing *s = of;
    for (size_t k = 0; k < sizeof s->taken / sizeof *s->taken; ++k) {
        size_t made = 0;
        s->taken[k] = arena_next(s->of, sizeof(uint64_t));
        if (s->taken[k] == NULL) {
            pthread_mutex_lock(s->lock);
            s->taken[k] = arena_take(s->of, &sizes, sizeof(uint64_t), &made);
            pthread_mutex_unlock(s->lock);
        }
        *s->taken[k] = s->mark + k;
    }
    return NULL;
}

START_TEST(threads_never_share_a_room)
{
    enum { THREADS = 4 };
    arena a = {NULL};
    pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static sharing of[THREADS];
    pthread_t thread[THREADS];
    for (uint64_t k = 0; k < THREADS; ++k) {
        of[k] = (sharing){.of = &a, .lock = &lock, .mark = k << 32};
        ck_assert_int_eq(pthread_create(&thread[k], NULL, take_many, &of[k]), 0);
    }
    size_t changed = 0;
    for (size_t k = 0; k < THREADS; ++k) pthread_join(thread[k], NULL);
    for (uint64_t k = 0; k < THREADS; ++k)
        for (size_t i = 0; i < sizeof of->taken / sizeof *of->taken; ++i)
            changed += *of[k].taken[i] != (k << 32) + i;
    ck_assert_uint_eq(changed, 0);
    arena_clear(&a);
}
END_TEST

SUITE_MAIN("arena", rooms_lie_apart_and_keep_what_is_in_them,
           blocks_grow_up_to_the_most_and_are_counted, threads_never_share_a_room)
