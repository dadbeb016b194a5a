/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/alloc_failure.h"

#include <errno.h>
#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The linker sends calls of f to __wrap_f, and calls of __real_f to f. */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void __wrap_free(void *block);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t length);

static size_t calls, failing;

static bool is_this_one(void)
{
    if (++calls != failing) return false;
    errno = ENOMEM;
    return true;
}

/* --- Blocks alive: open addressing; a block freed that is not ours is somebody else's --------- */

#define SLOTS ((size_t)1 << 16)
#define GONE ((void *)&calls) /* a slot once used, so that searches go on behind it */
static void *slot[SLOTS];
static size_t live;

static size_t home(const void *block)
{
    return (size_t)(((uintptr_t)block * 0x9E3779B97F4A7C15u) >> 48) % SLOTS;
}

static void *remember(void *block)
{
    if (block == NULL) return NULL;
    size_t at = home(block), probes = 0;
    while (slot[at] != NULL && slot[at] != GONE) {
        at = (at + 1) % SLOTS;
        if (++probes == SLOTS) {
            fputs("alloc_failure: too many blocks\n", stderr);
            abort();
        }
    }
    slot[at] = block;
    ++live;
    return block;
}

static void forget(const void *block)
{
    size_t at = home(block);
    for (size_t probes = 0; slot[at] != NULL && probes < SLOTS; ++probes, at = (at + 1) % SLOTS) {
        if (slot[at] != block) continue;
        slot[at] = GONE;
        --live;
        return;
    }
}

/* --- What the linker puts in place ------------------------------------------------------------ */

void *__wrap_malloc(size_t size) { return is_this_one() ? NULL : remember(__real_malloc(size)); }

void *__wrap_calloc(size_t count, size_t size)
{
    return is_this_one() ? NULL : remember(__real_calloc(count, size));
}

void *__wrap_realloc(void *old, size_t size)
{
    if (is_this_one()) return NULL;
    if (old != NULL) forget(old);
    void *block = __real_realloc(old, size);
    if (block == NULL) remember(old);
    return remember(block);
}

void __wrap_free(void *block)
{
    if (block != NULL) forget(block);
    __real_free(block);
}

char *__wrap_strndup(const char *text, size_t length)
{
    length = strnlen(text, length);
    char *copy = __wrap_malloc(length + 1);
    if (copy == NULL) return NULL;
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

char *__wrap_strdup(const char *text) { return __wrap_strndup(text, strlen(text)); }

/* --- The interface ---------------------------------------------------------------------------- */

void alloc_failure_begin(size_t n)
{
    json_set_alloc_funcs(__wrap_malloc, __wrap_free);
    calls = 0;
    failing = n;
}

bool alloc_failure_end(void)
{
    bool reached = calls >= failing;
    failing = 0;
    return reached;
}

size_t alloc_failure_calls(void) { return calls; }

size_t alloc_failure_live(void) { return live; }
