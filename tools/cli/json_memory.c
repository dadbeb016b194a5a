/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/json_memory.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdlib.h>

/* --- Small blocks that are used again --------------------------------------------------------- */

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <malloc.h>
#include <pthread.h>

/* Each number, array and key of JSON is a block or two. Each thread keeps the small ones that it
 * freed last, in lists by size: 24 bytes, as malloc rounds them, 40 and so on. The thread cache of
 * malloc holds seven blocks of a size; others take ten times as long. */
enum { LEAST = 24, STEP = 16, SIZES = 8, KEPT_MAX = 1024 };

typedef struct block {
    struct block *next;
} block;

typedef struct small_blocks {
    block *first[SIZES];
    size_t count[SIZES];
    bool is_known; /* to the key, so that they are freed when the thread ends */
} small_blocks;

static _Thread_local small_blocks kept;
static pthread_key_t key_of_kept;
static bool has_key;

static void free_kept(void *of)
{
    small_blocks *blocks = of;
    for (int k = 0; k < SIZES; ++k)
        while (blocks->first[k] != NULL) {
            block *next = blocks->first[k]->next;
            free(blocks->first[k]);
            blocks->first[k] = next;
        }
    *blocks = (small_blocks){.count = {0}};
}

static void prepare_blocks(void) { has_key = pthread_key_create(&key_of_kept, free_kept) == 0; }

static void *take_block(size_t size)
{
    const size_t k = size <= LEAST ? 0 : (size - LEAST + STEP - 1) / STEP;
    if (k >= SIZES) return malloc(size);
    block *taken = kept.first[k];
    if (taken == NULL) return malloc(LEAST + k * STEP);
    kept.first[k] = taken->next;
    --kept.count[k];
    return taken;
}

static bool may_keep(void)
{
    if (!kept.is_known) kept.is_known = has_key && pthread_setspecific(key_of_kept, &kept) == 0;
    return kept.is_known;
}

static void give_block(void *memory)
{
    const size_t size = memory != NULL ? malloc_usable_size(memory) : 0;
    const size_t k = size >= LEAST ? (size - LEAST) / STEP : SIZES;
    if (k >= SIZES || kept.count[k] == KEPT_MAX || !may_keep()) {
        free(memory);
        return;
    }
    block *given = memory;
    given->next = kept.first[k];
    kept.first[k] = given;
    ++kept.count[k];
}
#else
static void prepare_blocks(void) {}
static void *take_block(size_t size) { return malloc(size); }
static void give_block(void *memory) { free(memory); }
#endif

/* --- Failure ---------------------------------------------------------------------------------- */

/* Global, since Jansson's allocation functions have no context argument. */
static atomic_bool failed;

static void *allocate(size_t size)
{
    void *memory = atomic_load(&failed) ? NULL : take_block(size);
    if (memory != NULL) return memory;
    atomic_store(&failed, true);
    errno = ENOMEM;
    return NULL;
}

void json_memory_prepare(void)
{
    prepare_blocks();
    json_set_alloc_funcs(allocate, give_block);
}

bool json_memory_failed(void) { return atomic_load(&failed); }

char *json_memory_text(const json_t *value, size_t flags)
{
    char *text = value != NULL ? json_dumps(value, flags) : NULL;
    if (!json_memory_failed()) return text;
    free(text);
    return NULL;
}
