/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"

#include <impinge/impinge.h>

/* A handler has no arguments of ours, so this is the library's one variable of file scope. */
static _Thread_local struct {
    const char *volatile type, *volatile callback;
    const char *last; /* `type` of the callback begun last, also after its end */
} active_callback;

void active_callback_begin(const char *type, const char *callback)
{
    active_callback.callback = callback;
    active_callback.type = type;
    active_callback.last = type;
}

void active_callback_end(void) { active_callback.type = NULL; }

const char *active_callback_last(const char **callback)
{
    *callback = active_callback.callback;
    return active_callback.last;
}

const char *imp_call_in_progress(const char **callback)
{
    if (callback != NULL) *callback = active_callback.callback;
    return active_callback.type;
}
