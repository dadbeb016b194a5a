/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/json_memory.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>

/* Global, since Jansson's allocation functions have no context argument. */
static atomic_bool failed;

static void *allocate(size_t size)
{
    void *memory = atomic_load(&failed) ? NULL : malloc(size);
    if (memory != NULL) return memory;
    atomic_store(&failed, true);
    errno = ENOMEM;
    return NULL;
}

void json_memory_prepare(void) { json_set_alloc_funcs(allocate, free); }

bool json_memory_failed(void) { return atomic_load(&failed); }

char *json_memory_text(const json_t *value, size_t flags)
{
    char *text = value != NULL ? json_dumps(value, flags) : NULL;
    if (!json_memory_failed()) return text;
    free(text);
    return NULL;
}
