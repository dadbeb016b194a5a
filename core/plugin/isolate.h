/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ISOLATE_H
#define CORE_PLUGIN_ISOLATE_H

#include "core/plugin/reading_limits.h"
#include "core/plugin/worker_pool.h"
#include "core/surface/surface.h"

/* An instance in another process
 * =========================================
 * The plugin's create and all its callbacks run in the worker of its type; requests and replies go
 * through shared memory, points in batches. To the rest of core it is a type like any other. When
 * the worker crashes, exits, is killed or does not reply in time, the call returns SURFACE_CRASHED,
 * SURFACE_HUNG or SURFACE_KILLED, and so does every later one of this instance; those of other
 * instances in the same worker return SURFACE_LOST: an error of the query, not the end of the
 * host. In a process other than the one that made it every call returns SURFACE_FORKED. A call
 * costs a few microseconds. */

typedef struct isolated isolated;

/* A stand-in for the type, which must outlive it, as must the pool; NULL: no memory. Use
 * isolate_create next, whatever it returns, and release the instance by isolate_destroy, or by
 * `destroy` of the types below. */
isolated *isolate_surface(worker_pool *pool, const imp_surface_type *type);
isolated *isolate_map(worker_pool *pool, const imp_map_type *type);

/* Runs create in the worker. SURFACE_NO_PROCESS: no process could be made, why->text says why. */
imp_status isolate_create(isolated *i, const imp_value *values, imp_create_error *why);

/* Set the limits to which the worker holds create where it asks (imp_goes_on), and return which of
 * them it has reached. */
void isolate_limit(isolated *i, reading_limits limits);
reading_end isolate_end(const isolated *i);

/* The types whose `self` is `i`; they live as long as it does. */
const imp_surface_type *isolate_surface_type(const isolated *i);
const imp_map_type *isolate_map_type(const isolated *i);

void isolate_destroy(void *i);

/* Bytes that the host keeps for it and its pieces. */
size_t isolate_bytes(const isolated *i);

#endif
