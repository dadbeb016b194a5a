/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_WORKER_H
#define CORE_PLUGIN_WORKER_H

#include <pthread.h>
#include <stdbool.h>
#include <sys/types.h>

#include "core/plugin/channel.h"

/* A process that runs one type
 * ============================
 * The worker is forked from the host when the type is first used, and runs create, destroy and all
 * callbacks of every instance of that type. It has standard streams that lead to /dev/null, no
 * other descriptor of the host, its own process group (a signal to the host's group does not reach
 * it), and an address space that may grow by WORKER_MEMORY. When the host ends in whatever way, or
 * ends the worker, the whole group of the worker is killed, the plugin's own children included.
 *
 * A worker belongs to the process that started it. In a copy of that process (fork) every request
 * returns SURFACE_FORKED, and ending it frees memory only. */

enum { WORKER_DEADLINE_S = 5 }; /* for one request, or less: active_callback_limit */

#define WORKER_MEMORY ((size_t)4 << 30) /* bytes */

/* One of the two is NULL. */
typedef struct worker_type {
    const imp_surface_type *surface;
    const imp_map_type *map;
} worker_type;

typedef struct worker {
    worker_type type;
    channel *channel;
    pthread_mutex_t lock;
    pid_t process;       /* 0: none any more */
    pid_t owner;         /* the process that started it */
    int lifeline;        /* end of a pipe: the kernel kills the worker when it is closed */
    imp_status end;      /* IMP_STATUS_OK while it runs */
    const void *culprit; /* the instance whose request ended it */
    size_t users;        /* instances that exist; guarded by the pool */
} worker;

/* Starts a worker. The type must outlive it. NULL: no process could be made, errno says why. */
worker *worker_start(worker_type type);

/* Whether the worker still takes requests. */
bool worker_runs(worker *w);

/* Kills the worker and frees it. */
void worker_end(worker *w);

/* Takes the channel for one request of the instance `user` (an address, for comparison only).
 * IMP_STATUS_OK: fill in the request, call worker_request and read the reply, then worker_leave.
 * Anything else: the channel was not entered. */
imp_status worker_enter(worker *w, const void *user);
imp_status worker_request(worker *w, const void *user, channel_request what);
void worker_leave(worker *w);

/* The worker's side: serves requests until the channel ends. */
_Noreturn void worker_serve(channel *c, worker_type type);

#endif
