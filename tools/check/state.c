/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/state.h"

#include <link.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "tools/check/calls.h"

/* --- Ranges of memory, and copies of them ----------------------------------------------------- */

enum { RANGES = 32 };

typedef struct range {
    char *at;
    size_t size;
    char *copy; /* of before the calls; in separate pages, because the heap is compared */
    const char *what;
} range;

typedef struct watch {
    uintptr_t code; /* an address in the plugin */
    char *tls;      /* the plugin's thread-local variables, which may change */
    size_t tls_size;
    range range[RANGES];
    size_t count;
} watch;

static void add_range(watch *w, uintptr_t at, uintptr_t end, const char *what)
{
    if (w->count == RANGES || at >= end) return;
    char *copy = mmap(NULL, end - at, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (copy != MAP_FAILED) w->range[w->count++] = (range){(char *)at, end - at, copy, what};
}

/* Data that the loader makes read-only after relocation cannot be changed by the plugin. */
static void add_segments(watch *w, const struct dl_phdr_info *object)
{
    uintptr_t from = 0, to = 0;
    for (int k = 0; k < object->dlpi_phnum; ++k) {
        const ElfW(Phdr) *h = &object->dlpi_phdr[k];
        if (h->p_type != PT_GNU_RELRO) continue;
        from = object->dlpi_addr + h->p_vaddr;
        to = from + h->p_memsz;
    }
    for (int k = 0; k < object->dlpi_phnum; ++k) {
        const ElfW(Phdr) *h = &object->dlpi_phdr[k];
        const uintptr_t at = object->dlpi_addr + h->p_vaddr, end = at + h->p_memsz;
        if (h->p_type == PT_TLS) w->tls_size = h->p_memsz;
        if (h->p_type != PT_LOAD || (h->p_flags & PF_W) == 0) continue;
        add_range(w, at,
                  from > at && from < end ? from
                  : at >= from && at < to ? at
                                          : end,
                  "static data");
        add_range(w, to > at && to < end ? to : end, end, "static data");
    }
}

static bool holds(const struct dl_phdr_info *object, uintptr_t address)
{
    for (int k = 0; k < object->dlpi_phnum; ++k) {
        const ElfW(Phdr) *h = &object->dlpi_phdr[k];
        const uintptr_t at = object->dlpi_addr + h->p_vaddr;
        if (h->p_type == PT_LOAD && address >= at && address - at < h->p_memsz) return true;
    }
    return false;
}

static int look_at(struct dl_phdr_info *object, size_t size, void *data)
{
    watch *w = data;
    if (!holds(object, w->code)) return 0;
    add_segments(w, object);
    if (size >= offsetof(struct dl_phdr_info, dlpi_tls_data) + sizeof object->dlpi_tls_data)
        w->tls = object->dlpi_tls_data;
    return 1;
}

/* The heap of glibc's malloc; another malloc may use other memory. */
static void add_heap(watch *w)
{
    char line[512];
    unsigned long from, to;
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps != NULL && fgets(line, sizeof line, maps) != NULL)
        if (strstr(line, "[heap]") != NULL && sscanf(line, "%lx-%lx", &from, &to) == 2)
            add_range(w, from, to, "memory on the heap (such as the instance)");
    if (maps != NULL) fclose(maps);
}

/* The ranges hold what AddressSanitizer has poisoned around variables too: under it they are read
 * byte by byte, without its checks and without memcpy and memcmp, which it replaces. */
#ifdef __SANITIZE_ADDRESS__
__attribute__((no_sanitize("address"))) static void copy_all(char *to, const char *from, size_t n)
{
    const volatile char *byte = from;
    for (size_t i = 0; i < n; ++i) to[i] = byte[i];
}
__attribute__((no_sanitize("address"))) static bool are_equal(const char *a, const char *b,
                                                              size_t n)
{
    const volatile char *x = a, *y = b;
    for (size_t i = 0; i < n; ++i)
        if (x[i] != y[i]) return false;
    return true;
}
#else
static void copy_all(char *to, const char *from, size_t n) { memcpy(to, from, n); }
static bool are_equal(const char *a, const char *b, size_t n) { return memcmp(a, b, n) == 0; }
#endif

static void remember(watch *w)
{
    for (size_t k = 0; k < w->count; ++k)
        copy_all(w->range[k].copy, w->range[k].at, w->range[k].size);
}

static bool is_own(const watch *w, const char *at)
{
    return w->tls != NULL && at >= w->tls && at < w->tls + w->tls_size;
}

/* The first byte that is no longer what it was, or NULL. */
static const range *changed(const watch *w)
{
    for (size_t k = 0; k < w->count; ++k) {
        const range *r = &w->range[k];
        if (are_equal(r->copy, r->at, r->size)) continue;
        for (size_t i = 0; i < r->size; ++i)
            if (!are_equal(r->copy + i, r->at + i, 1) && !is_own(w, r->at + i)) return r;
    }
    return NULL;
}

static void forget(watch *w)
{
    for (size_t k = 0; k < w->count; ++k) munmap(w->range[k].copy, w->range[k].size);
}

/* --- Calls ------------------------------------------------------------------------------------ */

enum { CALLS = 24, WARM_UPS = 4, ROUNDS = 3 };

static void call_often(const subject *s, uint64_t *random, size_t which)
{
    for (int k = 0; k < CALLS; ++k) pure_call(s, which, random);
}

static bool leaves_alone(const subject *s, watch *w, uint64_t *random, size_t which)
{
    remember(w);
    call_often(s, random, which);
    const range *r = changed(w);
    ++s->answer->tests;
    return r == NULL ||
           answer_fail(s->answer,
                       "%s changes %s: called from several threads at once, it may answer wrongly",
                       pure_call_name(s, which), r->what);
}

static void check_calls(const subject *s, watch *w)
{
    uint64_t random = draw_stream(1, "state", "");
    for (int k = 0; k < WARM_UPS; ++k)
        for (size_t which = 0; which < PURE_CALLS; ++which) call_often(s, &random, which);
    for (int k = 0; k < ROUNDS; ++k)
        for (size_t which = 0; which < PURE_CALLS; ++which)
            if (!leaves_alone(s, w, &random, which)) return;
    answer_pass(s->answer, "calls change no static data, nor memory on the heap");
}

void state_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                 check_answer *answer)
{
    imp_instance made;
    imp_error error;
    subject s;
    watch w = {.count = 0};
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0); /* large instances are on the heap too */
#endif
    if (subject_create(registry, type->kind, stage, &made, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    w.code = made.surface != NULL ? (uintptr_t)made.surface->eval : (uintptr_t)made.map->eval;
    dl_iterate_phdr(look_at, &w);
    add_heap(&w);
    if (subject_make(&s, &made, &made, 0, answer)) check_calls(&s, &w);
    forget(&w);
    subject_destroy(&made, stage, answer);
}
