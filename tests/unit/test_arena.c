/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/arena.h"
#include "tests/support/suite.h"

static const arena_growth sizes = {256, 256, 400, 4096};

START_TEST(rooms_lie_apart_and_keep_what_is_in_them)
{
    enum { ROOMS = 2000 };
    uint64_t state = suite_seed();
    arena a = {NULL};
    unsigned char *room[ROOMS];
    size_t length[ROOMS], made = 0;
    for (size_t k = 0; k < ROOMS; ++k) {
        length[k] = 8 * (1 + random_bits(&state) % 12);
        room[k] = arena_take(&a, &sizes, length[k], &made, NULL);
        ck_assert_ptr_nonnull(room[k]);
        ck_assert_uint_eq((uintptr_t)room[k] % sizeof(double), 0);
        memset(room[k], (int)(k % 251), length[k]);
    }
    size_t changed = 0;
    for (size_t k = 0; k < ROOMS; ++k)
        for (size_t i = 0; i < length[k]; ++i) changed += room[k][i] != k % 251;
    ck_assert_uint_eq(changed, 0);
    arena_clear(&a, NULL);
    ck_assert_ptr_null(arena_next(&a, 8));
}
END_TEST

START_TEST(blocks_grow_up_to_the_most_and_are_counted)
{
    arena a = {NULL};
    size_t made = 0, before = 0;
    const size_t capacity[] = {256, 1024, 4096, 4096};
    for (size_t k = 0; k < sizeof capacity / sizeof *capacity; ++k) {
        ck_assert_ptr_nonnull(arena_take(&a, &sizes, 128, &made, NULL));
        ck_assert_uint_eq(made - before, sizeof(arena_block) + capacity[k]);
        before = made;
        for (size_t used = 128; used < capacity[k]; used += 128)
            ck_assert_ptr_nonnull(arena_next(&a, 128));
        ck_assert_ptr_null(arena_next(&a, 8));
        ck_assert_uint_eq(made, before);
    }
    ck_assert_ptr_nonnull(arena_take(&a, &sizes, 8192, &made, NULL)); /* more than the most */
    ck_assert_uint_eq(made - before, sizeof(arena_block) + 8192);
    arena_clear(&a, NULL);
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
            s->taken[k] = arena_take(s->of, &sizes, sizeof(uint64_t), &made, NULL);
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
    arena_clear(&a, NULL);
}
END_TEST

START_TEST(the_next_arena_has_the_blocks_of_the_last)
{
    arena_store *store = arena_store_new();
    ck_assert_ptr_nonnull(store);
    void *first[3] = {NULL};
    for (int round = 0; round < 100; ++round) {
        arena a = {NULL};
        size_t made = 0;
        for (int k = 0; k < 3; ++k) {
            void *room = arena_take(&a, &sizes, (size_t)256 << 2 * k, &made, store);
            ck_assert_ptr_nonnull(room);
            memset(room, round, (size_t)256 << 2 * k);
            if (round == 0)
                first[k] = room;
            else
                ck_assert(room == first[0] || room == first[1] || room == first[2]);
        }
        ck_assert_uint_eq(made, 3 * sizeof(arena_block) + 256 + 1024 + 4096);
        arena_clear(&a, store);
    }
    arena_store_free(store);
}
END_TEST

START_TEST(a_store_keeps_no_more_than_it_says)
{
    arena_store *store = arena_store_new();
    ck_assert_ptr_nonnull(store);
    const size_t capacity = ARENA_STORE_MOST / 8;
    const arena_growth large = {capacity, capacity, 100, capacity};
    arena a = {NULL};
    size_t made = 0, kept = 0;
    for (int k = 0; k < 20; ++k)
        ck_assert_ptr_nonnull(arena_take(&a, &large, capacity, &made, store));
    ck_assert_ptr_nonnull(arena_take(&a, &large, ARENA_STORE_MOST + 8, &made, store));
    arena_clear(&a, store);
    ck_assert_ptr_null(arena_store_take(store, ARENA_STORE_MOST + 8));
    ck_assert_ptr_null(arena_store_take(store, capacity - 8));
    for (arena_block *b; (b = arena_store_take(store, capacity)) != NULL; ++kept) free(b);
    ck_assert_uint_eq(kept, 8);
    arena_store_free(store);
}
END_TEST

static void *clear_many(void *of)
{
    for (uint64_t round = 0; round < 2000; ++round) {
        arena a = {NULL};
        uint64_t *room[4];
        size_t made = 0;
        for (uint64_t k = 0; k < 4; ++k) {
            room[k] = arena_take(&a, &sizes, 256, &made, of);
            *room[k] = (uint64_t)(uintptr_t)&a + 4 * round + k;
        }
        for (uint64_t k = 0; k < 4; ++k)
            if (*room[k] != (uint64_t)(uintptr_t)&a + 4 * round + k) return of;
        arena_clear(&a, of);
    }
    return NULL;
}

START_TEST(threads_never_have_the_same_block_of_a_store)
{
    enum { THREADS = 4 };
    arena_store *store = arena_store_new();
    ck_assert_ptr_nonnull(store);
    pthread_t thread[THREADS];
    for (int k = 0; k < THREADS; ++k)
        ck_assert_int_eq(pthread_create(&thread[k], NULL, clear_many, store), 0);
    for (int k = 0; k < THREADS; ++k) {
        void *fault = store;
        pthread_join(thread[k], &fault);
        ck_assert_ptr_null(fault);
    }
    arena_store_free(store);
}
END_TEST

SUITE_MAIN("arena", rooms_lie_apart_and_keep_what_is_in_them,
           blocks_grow_up_to_the_most_and_are_counted, threads_never_share_a_room,
           the_next_arena_has_the_blocks_of_the_last, a_store_keeps_no_more_than_it_says,
           threads_never_have_the_same_block_of_a_store)
