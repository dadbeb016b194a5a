/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/output_guard.h"

#include <assert.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { PATTERN = 0xA5 };

static size_t page_size(void) { return (size_t)sysconf(_SC_PAGESIZE); }

output_guard output_guard_make(void)
{
    const size_t page = page_size(), most = OUTPUT_GUARD_MOST + OUTPUT_GUARD_BEFORE,
                 room = (most + page - 1) / page * page;
    unsigned char *memory =
        mmap(NULL, room + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return (output_guard){.end = NULL};
    if (mprotect(memory + page, room, PROT_READ | PROT_WRITE) == 0)
        return (output_guard){.end = memory + page + room};
    munmap(memory, room + 2 * page);
    return (output_guard){.end = NULL};
}

void *output_guard_lend(output_guard *g, void *of, size_t size)
{
    assert(size <= OUTPUT_GUARD_MOST);
    if (g->end == NULL) return of;
    g->of = of;
    g->size = size;
    memset(g->end - size - OUTPUT_GUARD_BEFORE, PATTERN, OUTPUT_GUARD_BEFORE);
    return memcpy(g->end - size, of, size);
}

/* Each byte equals the next, and the first is the pattern. */
bool output_guard_take_back(output_guard *g)
{
    if (g->of == NULL) return true;
    const unsigned char *first = g->end - g->size - OUTPUT_GUARD_BEFORE;
    const bool kept = first[0] == PATTERN && memcmp(first, first + 1, OUTPUT_GUARD_BEFORE - 1) == 0;
    memcpy(g->of, g->end - g->size, g->size);
    g->of = NULL;
    return kept;
}
