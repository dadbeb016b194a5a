/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/array.h"
#include "core/plugin/worker_pool.h"

#include <errno.h>
#include <unistd.h>

struct worker_pool {
    pthread_mutex_t lock;
    pid_t owner;
    worker **worker;
    size_t count, capacity;
};

worker_pool *worker_pool_new(void)
{
    worker_pool *pool = calloc(1, sizeof *pool);
    if (pool == NULL) return NULL;
    pool->owner = getpid();
    pthread_mutex_init(&pool->lock, NULL);
    return pool;
}

void worker_pool_free(worker_pool *pool)
{
    if (pool == NULL) return;
    for (size_t k = 0; k < pool->count; ++k) worker_end(pool->worker[k]);
    pthread_mutex_destroy(&pool->lock);
    free(pool->worker);
    free(pool);
}

static worker *find(worker_pool *pool, worker_type type)
{
    for (size_t k = 0; k < pool->count; ++k) {
        worker *w = pool->worker[k];
        if (w->type.surface == type.surface && w->type.map == type.map && worker_runs(w)) return w;
    }
    return NULL;
}

static worker *start(worker_pool *pool, worker_type type)
{
    worker **grown = array_reserve(pool->worker, pool->count, &pool->capacity, sizeof *grown);
    if (grown == NULL) return NULL;
    pool->worker = grown;
    worker *w = worker_start(type);
    if (w != NULL) pool->worker[pool->count++] = w;
    return w;
}

/* In a copy of the process that made the pool there is nothing to take, and its lock may have been
 * copied while it was held. */
worker *worker_pool_take(worker_pool *pool, worker_type type)
{
    if (pool->owner != getpid()) {
        errno = ECHILD;
        return NULL;
    }
    pthread_mutex_lock(&pool->lock);
    worker *w = find(pool, type);
    if (w == NULL) w = start(pool, type);
    if (w != NULL) w->users += 1;
    pthread_mutex_unlock(&pool->lock);
    return w;
}

/* One that runs stays for the next instance; one that has ended has served. */
void worker_pool_return(worker_pool *pool, worker *w)
{
    if (pool->owner != getpid()) return;
    pthread_mutex_lock(&pool->lock);
    w->users -= 1;
    size_t k = 0;
    while (pool->worker[k] != w) ++k;
    if (w->users == 0 && !worker_runs(w)) {
        pool->worker[k] = pool->worker[--pool->count];
        worker_end(w);
    }
    pthread_mutex_unlock(&pool->lock);
}
