/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_WORKER_INTERNAL_H
#define CORE_PLUGIN_WORKER_INTERNAL_H

#include <sys/types.h>

#include "core/plugin/output_guard.h"
#include "core/plugin/worker.h"

/* What the worker's side of a channel consists of: worker_serve.c answers requests,
 * worker_create.c those that create an instance and tell of its pieces. */

/* What the worker keeps between requests: the bytes of values that have come so far. And what it
 * works on: a copy made by a callback that forks goes on to write what that callback is to
 * answer. */
typedef struct worker_server {
    channel *with;
    channel_work work;
    worker_type type;
    pid_t process;
    const volatile unsigned char *original; /* not 0 in this process, 0 in its copies; or NULL */
    unsigned char *bytes;
    size_t length, capacity;
    output_guard out[2]; /* what the callback that is called worker_fills */
} worker_server;

/* Returns memory that a callback fills in the place of `of`; k is 0 or 1. */
void *worker_fills(worker_server *s, int k, void *of, size_t size);

/* Takes back what the callback has filled. A callback that wrote before what it fills ends as one
 * that wrote past the end does. */
void worker_take_back(worker_server *s);

/* Ends this process where it is a copy: only the worker itself goes on after a callback. */
void worker_end_copies(const worker_server *s);

imp_status worker_receive(worker_server *s);
imp_status worker_create(worker_server *s);
imp_status worker_pieces(worker_server *s);

/* Bounds pieces, each over its whole domain at the times of the region that was sent. */
imp_status worker_include_pieces(worker_server *s);

#endif
