/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_WORKER_POOL_H
#define CORE_PLUGIN_WORKER_POOL_H

#include "core/plugin/worker.h"

/* The workers of one registry
 * ===========================
 * One for each type that is in use, started when first wanted. A worker that has ended is replaced
 * by a new one at the next instance. Safe from many threads. */

typedef struct worker_pool worker_pool;

/* Makes an empty pool. NULL: no memory. */
worker_pool *worker_pool_new(void);

/* Ends all workers; no instance may be left. NULL is accepted. */
void worker_pool_free(worker_pool *pool);

/* Gets a worker that runs the type, for one more instance. NULL: errno says why. */
worker *worker_pool_take(worker_pool *pool, worker_type type);

/* Counts one instance less. */
void worker_pool_return(worker_pool *pool, worker *w);

/* Keeps how destroy ended a worker of the type: the first of each type, unless memory runs out. */
void worker_pool_note(worker_pool *pool, worker_type type, imp_status end);

/* Tells what was kept, in order: "destroy of 'x' crashes ..."; the text lives as long as the pool.
 * False: past the last, or in another process than the one that made the pool. */
bool worker_pool_fault(worker_pool *pool, size_t index, worker_type *type, const char **text);

#endif
