/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/crew.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>

#include "core/common/c_locale.h"
#include "tools/cli/crash.h"

typedef struct crew_work {
    void (*work)(void *of, size_t index);
    void *of;
    size_t count;
    atomic_size_t next;
} crew_work;

static void take_all(crew_work *w)
{
    for (size_t k; (k = atomic_fetch_add(&w->next, 1)) < w->count;) w->work(w->of, k);
}

static void *member(void *context)
{
    void *stack = crash_thread_begin();
    c_locale_enter(); /* as main does */
    pthread_cleanup_push(crash_thread_left, NULL);
    take_all(context);
    pthread_cleanup_pop(0);
    crash_thread_end(stack);
    return NULL;
}

/* Signals are the main thread's. */
static size_t start(pthread_t *threads, size_t count, crew_work *w)
{
    sigset_t ours, before;
    size_t started = 0;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    sigaddset(&ours, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &ours, &before);
    while (started < count && pthread_create(&threads[started], NULL, member, w) == 0) ++started;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

void crew_run(void *context, void (*work)(void *of, size_t index), void *of, size_t count)
{
    enum { MEMBERS_MAX = 256 };
    const crew *c = context;
    pthread_t threads[MEMBERS_MAX];
    crew_work w = {.work = work, .of = of, .count = count};
    const size_t wanted = c->threads < count ? c->threads : count;
    const size_t others = wanted > MEMBERS_MAX ? MEMBERS_MAX : wanted > 0 ? wanted - 1 : 0;
    const size_t started = start(threads, others, &w);
    take_all(&w);
    for (size_t k = 0; k < started; ++k) pthread_join(threads[k], NULL);
}
