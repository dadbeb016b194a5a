/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"

#include <impinge/impinge.h>
#include <stdatomic.h>

/* Others may read it while its thread is in a callback, or comes and goes. */
struct imp_call {
    const char *_Atomic type;
    const char *_Atomic callback;
    const char *last; /* `type` of the callback begun last, also after its end */
};

/* A handler has no arguments of ours, so this is the library's one variable of file scope. */
static _Thread_local imp_call active_callback;

void active_callback_begin(const char *type, const char *callback)
{
    atomic_store_explicit(&active_callback.callback, callback, memory_order_relaxed);
    atomic_store_explicit(&active_callback.type, type, memory_order_release);
    active_callback.last = type;
}

void active_callback_end(void)
{
    atomic_store_explicit(&active_callback.type, NULL, memory_order_release);
}

const char *active_callback_last(const char **callback)
{
    *callback = atomic_load_explicit(&active_callback.callback, memory_order_relaxed);
    return active_callback.last;
}

const imp_call *imp_call_of_thread(void) { return &active_callback; }

const char *imp_call_read(const imp_call *call, const char **callback)
{
    if (call == NULL) return NULL;
    const char *type = atomic_load_explicit(&call->type, memory_order_acquire);
    if (callback != NULL)
        *callback = atomic_load_explicit(&call->callback, memory_order_relaxed);
    return type;
}

const char *imp_call_in_progress(const char **callback)
{
    return imp_call_read(&active_callback, callback);
}
