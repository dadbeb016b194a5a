/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_ACTIVE_CALLBACK_H
#define CORE_BASE_ACTIVE_CALLBACK_H

#include <impinge/impinge.h>
#include <stdatomic.h>
#include <stddef.h>

/* The plugin that each thread is in, so that a crash is blamed on the right one: a signal handler
 * of the program asks imp_call_in_progress. It is set before a callback and cleared after the last
 * of a group, by a few stores. */

/* Others may read it while its thread is in a callback, or comes and goes. */
struct imp_call {
    const char *_Atomic type; /* NULL: it is in none */
    const char *_Atomic callback;
    const char *last; /* `type` of the callback begun last, also after its end */
    double until;     /* by when callbacks must answer, on the clock; 0: at any time */
};

/* Returns the record of this thread. */
imp_call *active_callback_own(void);

static inline imp_call *active_callback_begin(const char *type, const char *callback)
{
    imp_call *call = active_callback_own();
    atomic_store_explicit(&call->callback, callback, memory_order_relaxed);
    atomic_store_explicit(&call->type, type, memory_order_release);
    call->last = type;
    return call;
}

/* `call` is what active_callback_begin answered in this thread. */
static inline void active_callback_end(imp_call *call)
{
    atomic_store_explicit(&call->type, NULL, memory_order_release);
}

/* Sets by when callbacks of this thread must answer (seconds of the clock; 0: at any time), and
 * returns what was set before. Only isolated ones can be held to it (worker.h). */
static inline double active_callback_limit(double until)
{
    imp_call *call = active_callback_own();
    const double before = call->until;
    call->until = until;
    return before;
}

/* The type and callback begun last in this thread, for messages about what it answered. */
const char *active_callback_last(const char **callback);

#endif
