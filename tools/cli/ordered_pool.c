/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/ordered_pool.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>

#include "core/common/c_locale.h"
#include "tools/cli/crash.h"

/* Counters that only grow: finished <= taken <= submitted <= finished + items. Item k is in slot
 * k % items. */
struct ordered_pool {
    ordered_pool_plan plan;
    char *items;
    bool *worked; /* by slot */
    size_t submitted, taken, finished;
    size_t idle; /* workers that wait */
    bool finishing, stopped, closed;
    pthread_mutex_t lock;
    pthread_cond_t work_or_end, room;
    pthread_t *threads;
    size_t started;
};

static void *slot_of(ordered_pool *pool, size_t k)
{
    return pool->items + (k % pool->plan.items) * pool->plan.item_size;
}

/* --- Workers; the lock is held at entry and exit of each -------------------------------------- */

/* The worker that completes the oldest item finishes it and all complete items after it. */
static void finish_in_order(ordered_pool *pool)
{
    if (pool->finishing) return; /* another worker finishes items now, and will check again */
    pool->finishing = true;
    while (pool->finished < pool->taken && pool->worked[pool->finished % pool->plan.items]) {
        void *item = slot_of(pool, pool->finished);
        pthread_mutex_unlock(&pool->lock);
        const bool go_on = pool->plan.finish(pool->plan.context, item);
        pthread_mutex_lock(&pool->lock);
        pool->stopped = pool->stopped || !go_on;
        pool->worked[pool->finished % pool->plan.items] = false;
        pool->finished += 1;
        /* not for every item: waking the owner for each costs more than an easy item's work */
        if (pool->stopped || 2 * (pool->submitted - pool->finished) <= pool->plan.items)
            pthread_cond_signal(&pool->room);
    }
    pool->finishing = false;
}

static void take_one(ordered_pool *pool)
{
    const size_t k = pool->taken++;
    pthread_mutex_unlock(&pool->lock);
    pool->plan.work(pool->plan.context, slot_of(pool, k));
    pthread_mutex_lock(&pool->lock);
    pool->worked[k % pool->plan.items] = true;
    finish_in_order(pool);
}

static void *worker(void *context)
{
    ordered_pool *pool = context;
    void *stack = crash_thread_begin();
    c_locale_enter(); /* as main does */
    pthread_cleanup_push(crash_thread_left, NULL);
    pthread_mutex_lock(&pool->lock);
    while (!pool->closed || pool->taken < pool->submitted) {
        if (pool->taken < pool->submitted) {
            take_one(pool);
        } else {
            pool->idle += 1;
            pthread_cond_wait(&pool->work_or_end, &pool->lock);
            pool->idle -= 1;
        }
    }
    pthread_mutex_unlock(&pool->lock);
    pthread_cleanup_pop(0);
    crash_thread_end(stack);
    return NULL;
}

/* --- The owner -------------------------------------------------------------------------------- */

static bool start_threads(ordered_pool *pool)
{
    sigset_t ours, before;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    sigaddset(&ours, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ours, &before);
    while (pool->started < pool->plan.threads &&
           pthread_create(&pool->threads[pool->started], NULL, worker, pool) == 0)
        pool->started += 1;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return pool->started > 0;
}

ordered_pool *ordered_pool_new(const ordered_pool_plan *plan)
{
    ordered_pool *pool = calloc(1, sizeof *pool);
    if (pool == NULL) return NULL;
    pool->plan = *plan;
    pool->items = calloc(plan->items, plan->item_size);
    pool->worked = calloc(plan->items, sizeof *pool->worked);
    pool->threads = calloc(plan->threads, sizeof *pool->threads);
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->work_or_end, NULL);
    pthread_cond_init(&pool->room, NULL);
    if (pool->items != NULL && pool->worked != NULL && pool->threads != NULL && start_threads(pool))
        return pool;
    ordered_pool_free(pool);
    return NULL;
}

void *ordered_pool_next(ordered_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    while (!pool->stopped && pool->submitted - pool->finished == pool->plan.items)
        pthread_cond_wait(&pool->room, &pool->lock);
    void *item = pool->stopped ? NULL : slot_of(pool, pool->submitted);
    pthread_mutex_unlock(&pool->lock);
    return item;
}

void ordered_pool_submit(ordered_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    pool->submitted += 1;
    if (pool->idle > 0) pthread_cond_signal(&pool->work_or_end);
    pthread_mutex_unlock(&pool->lock);
}

void ordered_pool_join(ordered_pool *pool)
{
    pthread_mutex_lock(&pool->lock);
    pool->closed = true;
    pthread_cond_broadcast(&pool->work_or_end);
    pthread_mutex_unlock(&pool->lock);
    for (size_t k = 0; k < pool->started; ++k) pthread_join(pool->threads[k], NULL);
    pool->started = 0;
}

void *ordered_pool_item(ordered_pool *pool, size_t k) { return slot_of(pool, k); }

void ordered_pool_free(ordered_pool *pool)
{
    if (pool == NULL) return;
    pthread_cond_destroy(&pool->room);
    pthread_cond_destroy(&pool->work_or_end);
    pthread_mutex_destroy(&pool->lock);
    free(pool->threads);
    free(pool->worked);
    free(pool->items);
    free(pool);
}
