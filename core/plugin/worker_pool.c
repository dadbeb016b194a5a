/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/array.h"
#include "core/plugin/worker_pool.h"
#include "core/surface/surface.h"

#include <errno.h>
#include <stdio.h>
#include <unistd.h>

typedef struct worker_fault {
    worker_type type;
    char *text;
} worker_fault;

struct worker_pool {
    pthread_mutex_t lock;
    pid_t owner;
    worker **worker;
    size_t count, capacity;
    worker_fault *fault;
    size_t fault_count, fault_capacity;
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
    for (size_t k = 0; k < pool->fault_count; ++k) free(pool->fault[k].text);
    pthread_mutex_destroy(&pool->lock);
    free(pool->fault);
    free(pool->worker);
    free(pool);
}

static bool is_same(worker_type a, worker_type b)
{
    return a.surface == b.surface && a.map == b.map;
}

static worker *find(worker_pool *pool, worker_type type)
{
    for (size_t k = 0; k < pool->count; ++k) {
        worker *w = pool->worker[k];
        if (is_same(w->type, type) && worker_runs(w)) return w;
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

static void note(worker_pool *pool, worker_type type, imp_status end)
{
    for (size_t k = 0; k < pool->fault_count; ++k)
        if (is_same(pool->fault[k].type, type)) return;
    worker_fault made = {.type = type};
    worker_fault *grown =
        array_reserve(pool->fault, pool->fault_count, &pool->fault_capacity, sizeof *grown);
    if (grown == NULL) return;
    pool->fault = grown;
    if (asprintf(&made.text, "destroy of '%s' %s",
                 type.surface != NULL ? type.surface->name : type.map->name,
                 surface_status_text(end)) >= 0)
        pool->fault[pool->fault_count++] = made;
}

void worker_pool_note(worker_pool *pool, worker_type type, imp_status end)
{
    if (pool->owner != getpid()) return;
    pthread_mutex_lock(&pool->lock);
    note(pool, type, end);
    pthread_mutex_unlock(&pool->lock);
}

bool worker_pool_fault(worker_pool *pool, size_t index, worker_type *type, const char **text)
{
    if (pool->owner != getpid()) return false;
    pthread_mutex_lock(&pool->lock);
    const bool found = index < pool->fault_count;
    if (found) {
        *type = pool->fault[index].type;
        *text = pool->fault[index].text;
    }
    pthread_mutex_unlock(&pool->lock);
    return found;
}
