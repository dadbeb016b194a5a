/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_ORDERED_POOL_H
#define TOOLS_CLI_ORDERED_POOL_H

#include <stdbool.h>
#include <stddef.h>

/* A pool of threads over a stream of items, with results in the order of the input
 * ================================================================================
 * One thread, the owner, fills items and submits them; workers work on them in any order; each item
 * is finished in the order of submission, one at a time, as soon as those before it are. The number
 * of items is fixed, so that an endless stream needs constant memory: the owner waits for a free
 * item. */

typedef struct ordered_pool_plan {
    size_t threads; /* >= 1 */
    size_t items;   /* >= threads: items that may be in progress at once */
    size_t item_size;
    void (*work)(void *context, void *item);   /* [worker threads] */
    bool (*finish)(void *context, void *item); /* [worker threads, one at a time] false: stop */
    void *context;
} ordered_pool_plan;

typedef struct ordered_pool ordered_pool;

/* Items begin as zeros and keep what finish leaves in them. NULL: no memory, or no thread. Workers
 * take no SIGINT and no SIGTERM. */
ordered_pool *ordered_pool_new(const ordered_pool_plan *plan);

/* Returns the next item to fill; waits for a free one. NULL: finish has stopped the pool. */
void *ordered_pool_next(ordered_pool *pool);

/* Hands the item of the last ordered_pool_next to the workers. */
void ordered_pool_submit(ordered_pool *pool);

/* Waits until all that was submitted is finished, and ends the threads. */
void ordered_pool_join(ordered_pool *pool);

/* Returns item k of plan.items, after ordered_pool_join, so that the caller can free its
 * contents. */
void *ordered_pool_item(ordered_pool *pool, size_t k);

void ordered_pool_free(ordered_pool *pool);

#endif
