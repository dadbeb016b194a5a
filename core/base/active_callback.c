/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"

/* A handler has no arguments of ours, so this is the library's one variable of file scope. */
static _Thread_local imp_call active_callback;

imp_call *active_callback_own(void) { return &active_callback; }

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
    if (callback != NULL) *callback = atomic_load_explicit(&call->callback, memory_order_relaxed);
    return type;
}

const char *imp_call_in_progress(const char **callback)
{
    return imp_call_read(&active_callback, callback);
}
