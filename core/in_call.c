/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "in_call.h"

#include <impinge/impinge.h>

/* A handler has no arguments of ours, so this is the library's one variable of file scope. */
static _Thread_local struct {
    const char *volatile type, *volatile callback;
} in_call;

void in_call_begin(const char *type, const char *callback)
{
    in_call.callback = callback;
    in_call.type = type;
}

void in_call_end(void) { in_call.type = NULL; }

const char *imp_call_in_progress(const char **callback)
{
    if (callback != NULL) *callback = in_call.callback;
    return in_call.type;
}
