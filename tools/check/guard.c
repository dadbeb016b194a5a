/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/guard.h"

#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static size_t page_size(void) { return (size_t)sysconf(_SC_PAGESIZE); }

bool guard_make(guard *g, size_t room)
{
    const size_t page = page_size(), size = (room + page - 1) / page * page;
    *g = (guard){NULL, 0};
    char *memory =
        mmap(NULL, size + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return false;
    *g = (guard){memory + size, size};
    return mprotect(g->end, page, PROT_NONE) == 0;
}

void *guard_place(guard *g, const void *data, size_t size)
{
    if (size > g->size) return NULL;
    char *to = g->end - size;
    if (data != NULL)
        memcpy(to, data, size);
    else
        memset(to, 0xff, size);
    return to;
}

void guard_hide(guard *g)
{
    if (g->end != NULL) mprotect(g->end - g->size, g->size, PROT_NONE);
}

void guard_free(guard *g)
{
    if (g->end != NULL) munmap(g->end - g->size, g->size + page_size());
    *g = (guard){NULL, 0};
}
