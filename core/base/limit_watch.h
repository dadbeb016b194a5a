/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_LIMIT_WATCH_H
#define CORE_BASE_LIMIT_WATCH_H

#include <stdbool.h>
#include <stddef.h>

#include <impinge/impinge.h>

/* What ends long computations: asked now and then, whether to go on. */
typedef struct limit_watch {
    imp_go_on go_on; /* NULL: always */
    void *context;
} limit_watch;

static inline bool limit_watch_goes_on(const limit_watch *w)
{
    return w->go_on == NULL || w->go_on(w->context);
}

#endif
