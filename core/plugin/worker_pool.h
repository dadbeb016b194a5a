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

/* NULL: no memory. */
worker_pool *worker_pool_new(void);

/* Ends all workers; no instance may be left. NULL is accepted. */
void worker_pool_free(worker_pool *pool);

/* A worker that runs the type, for one more instance. NULL: errno says why. */
worker *worker_pool_take(worker_pool *pool, worker_type type);

/* One instance less. */
void worker_pool_return(worker_pool *pool, worker *w);

#endif
