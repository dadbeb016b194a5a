/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* To be preloaded: the allocation of that number fails, and with "N-" all after it too:
 * FAIL_ALLOCATION=17 or 17-. COUNT_ALLOCATIONS=FILE writes to a file how many there were. */

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

static atomic_ulong count, wanted;
static atomic_bool for_good;

__attribute__((constructor)) static void prepare(void)
{
    const char *text = getenv("FAIL_ALLOCATION");
    char *end;
    if (text == NULL) return;
    const unsigned long number = strtoul(text, &end, 10);
    for_good = *end == '-';
    count = 0;
    wanted = number;
}

__attribute__((destructor)) static void report(void)
{
    const char *path = getenv("COUNT_ALLOCATIONS");
    const unsigned long total = count;
    FILE *file = path != NULL ? fopen(path, "w") : NULL;
    if (file == NULL) return;
    fprintf(file, "%lu\n", total);
    fclose(file);
}

static bool fails(void)
{
    const unsigned long number = atomic_fetch_add(&count, 1) + 1;
    if (wanted == 0 || number < wanted || (number > wanted && !for_good)) return false;
    errno = ENOMEM;
    return true;
}

#define SEEN __attribute__((visibility("default")))

SEEN void *malloc(size_t size) { return fails() ? NULL : __libc_malloc(size); }

SEEN void *calloc(size_t n, size_t size) { return fails() ? NULL : __libc_calloc(n, size); }

SEEN void *realloc(void *old, size_t size) { return fails() ? NULL : __libc_realloc(old, size); }
