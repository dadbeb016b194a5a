/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/malloc_watch.h"

#include <errno.h>
#include <link.h>
#include <malloc.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* --- Replacements ----------------------------------------------------------------------------- */

static _Thread_local bool is_watching;
static _Thread_local const char *first_call;

static void note(const char *name)
{
    if (is_watching && first_call == NULL) first_call = name;
}

static void *noted_malloc(size_t size)
{
    note("malloc");
    return malloc(size);
}

static void *noted_calloc(size_t count, size_t size)
{
    note("calloc");
    return calloc(count, size);
}

static void *noted_realloc(void *block, size_t size)
{
    note("realloc");
    return realloc(block, size);
}

static void *noted_aligned_alloc(size_t alignment, size_t size)
{
    note("aligned_alloc");
    return aligned_alloc(alignment, size);
}

static void *noted_memalign(size_t alignment, size_t size)
{
    note("memalign");
    return memalign(alignment, size);
}

static int noted_posix_memalign(void **block, size_t alignment, size_t size)
{
    note("posix_memalign");
    return posix_memalign(block, alignment, size);
}

static void noted_free(void *block)
{
    note("free");
    free(block);
}

typedef void function(void);

static const struct {
    const char *name;
    function *instead;
} replaced[] = {
    {"malloc", (function *)noted_malloc},     {"calloc", (function *)noted_calloc},
    {"realloc", (function *)noted_realloc},   {"aligned_alloc", (function *)noted_aligned_alloc},
    {"memalign", (function *)noted_memalign}, {"posix_memalign", (function *)noted_posix_memalign},
    {"free", (function *)noted_free},
};

static function *replacement_of(const char *name)
{
    for (size_t k = 0; k < sizeof replaced / sizeof *replaced; ++k)
        if (strcmp(name, replaced[k].name) == 0) return replaced[k].instead;
    return NULL;
}

/* --- Tables of a loaded object ---------------------------------------------------------------- */

typedef struct tables {
    ElfW(Addr) base;
    const ElfW(Sym) * symbols;
    const char *names;
    const ElfW(Rela) * relocations[2]; /* those of data, and those of calls */
    size_t size[2];                    /* bytes */
} tables;

/* Addresses in the dynamic section are relocated by some loaders, and by others not. */
static const void *address_of(const tables *t, ElfW(Addr) value)
{
    return (const void *)(value < t->base ? t->base + value : value);
}

static tables tables_of(const struct dl_phdr_info *object)
{
    tables t = {.base = object->dlpi_addr};
    const ElfW(Dyn) *entry = NULL;
    for (int k = 0; k < object->dlpi_phnum; ++k)
        if (object->dlpi_phdr[k].p_type == PT_DYNAMIC)
            entry = (const void *)(t.base + object->dlpi_phdr[k].p_vaddr);
    for (; entry != NULL && entry->d_tag != DT_NULL; ++entry) {
        const ElfW(Addr) value = entry->d_un.d_ptr;
        if (entry->d_tag == DT_SYMTAB) t.symbols = address_of(&t, value);
        if (entry->d_tag == DT_STRTAB) t.names = address_of(&t, value);
        if (entry->d_tag == DT_RELA) t.relocations[0] = address_of(&t, value);
        if (entry->d_tag == DT_RELASZ) t.size[0] = value;
        if (entry->d_tag == DT_JMPREL) t.relocations[1] = address_of(&t, value);
        if (entry->d_tag == DT_PLTRELSZ) t.size[1] = value;
    }
    return t;
}

/* The loader may have made the page read-only. */
static bool write_address(ElfW(Addr) at, function *value)
{
    const ElfW(Addr) page = (ElfW(Addr))sysconf(_SC_PAGESIZE), from = at / page * page;
    if (mprotect((void *)from, (size_t)page, PROT_READ | PROT_WRITE) != 0) return false;
    memcpy((void *)at, &value, sizeof value);
    return true;
}

static size_t replace_in(const tables *t, int which)
{
    size_t count = 0;
    const ElfW(Rela) *r = t->relocations[which];
    for (size_t k = 0; r != NULL && k < t->size[which] / sizeof *r; ++k) {
        const size_t symbol = ELF64_R_SYM(r[k].r_info);
        if (symbol == 0) continue;
        function *instead = replacement_of(t->names + t->symbols[symbol].st_name);
        if (instead != NULL) count += write_address(t->base + r[k].r_offset, instead);
    }
    return count;
}

static bool holds(const struct dl_phdr_info *object, ElfW(Addr) address)
{
    for (int k = 0; k < object->dlpi_phnum; ++k) {
        const ElfW(Phdr) *h = &object->dlpi_phdr[k];
        const ElfW(Addr) from = object->dlpi_addr + h->p_vaddr;
        if (h->p_type == PT_LOAD && address >= from && address - from < h->p_memsz) return true;
    }
    return false;
}

static int replace_all(struct dl_phdr_info *object, size_t size, void *data)
{
    const tables t = tables_of(object);
    (void)size;
    if (t.symbols == NULL || t.names == NULL || holds(object, (ElfW(Addr))noted_malloc)) return 0;
    for (int which = 0; which < 2; ++which) *(size_t *)data += replace_in(&t, which);
    return 0;
}

/* --- Watching --------------------------------------------------------------------------------- */

bool malloc_watch_begin(void)
{
    size_t count = 0;
    dl_iterate_phdr(replace_all, &count);
    return count > 0;
}

void malloc_watch_start(void)
{
    first_call = NULL;
    is_watching = true;
}

const char *malloc_watch_stop(void)
{
    is_watching = false;
    return first_call;
}
