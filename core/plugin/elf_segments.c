/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_segments.h"

#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

__attribute__((format(printf, 4, 5))) static bool refuse(unsigned index, char *text, size_t size,
                                                         const char *format, ...)
{
    const int used = snprintf(text, size, "program header %u ", index);
    va_list arguments;
    va_start(arguments, format);
    if (used > 0 && (size_t)used < size)
        vsnprintf(text + used, size - (size_t)used, format, arguments);
    va_end(arguments);
    return false;
}

static bool wraps(const Elf64_Phdr *s, uint64_t page)
{
    return s->p_vaddr > UINT64_MAX - page || s->p_memsz > UINT64_MAX - page - s->p_vaddr;
}

/* Neither of these wraps around, since `wraps` was checked before. */
static uint64_t first_page(const Elf64_Phdr *s, uint64_t page) { return s->p_vaddr & ~(page - 1); }
static uint64_t end_page(const Elf64_Phdr *s, uint64_t page)
{
    return (s->p_vaddr + s->p_memsz + page - 1) & ~(page - 1);
}

static bool is_aligned(const Elf64_Phdr *s, uint64_t page)
{
    const uint64_t step = s->p_align;
    return step >= page && (step & (step - 1)) == 0 && (s->p_vaddr - s->p_offset) % step == 0;
}

static bool check_in_file(const elf_file *file, unsigned index, const Elf64_Phdr *s, char *text,
                          size_t size)
{
    if (elf_file_has(file, s->p_offset, s->p_filesz)) return true;
    return refuse(index, text, size, "takes bytes %llu and %llu more, the file has %llu",
                  (unsigned long long)s->p_offset, (unsigned long long)s->p_filesz,
                  (unsigned long long)file->size);
}

static bool add_load(const elf_file *file, unsigned index, const Elf64_Phdr *s, elf_loads *l,
                     char *text, size_t size)
{
    if (!check_in_file(file, index, s, text, size)) return false;
    if (s->p_filesz > s->p_memsz || wraps(s, l->page))
        return refuse(index, text, size, "does not fit into memory");
    if (!is_aligned(s, l->page))
        return refuse(index, text, size, "is not aligned to pages of %llu bytes",
                      (unsigned long long)l->page);
    if (l->count > 0 && first_page(s, l->page) < end_page(&l->part[l->count - 1], l->page))
        return refuse(index, text, size, "overlaps the loadable part before it, or lies below it");
    if (l->count == ELF_LOADS_MAX)
        return refuse(index, text, size, "is loadable part number %d, must be at most %d",
                      ELF_LOADS_MAX + 1, ELF_LOADS_MAX);
    l->part[l->count++] = *s;
    return true;
}

static bool read_loads(elf_file *file, elf_loads *l, char *text, size_t size)
{
    for (unsigned i = 0; i < file->header.e_phnum; ++i) {
        Elf64_Phdr s;
        if (!elf_file_segment(file, i, &s)) return refuse(i, text, size, "cannot be read");
        if (s.p_type == PT_LOAD && !add_load(file, i, &s, l, text, size)) return false;
    }
    return true;
}

/* Thread-local storage is copied from its bytes in the file; the rest of it is elsewhere. */
static uint64_t used_memory(const Elf64_Phdr *s)
{
    return s->p_type == PT_TLS ? s->p_filesz : s->p_memsz;
}

/* A linker may round the end of PT_GNU_RELRO up to a page, which is mapped all the same. */
static bool is_inside(const Elf64_Phdr *s, const elf_loads *l)
{
    const uint64_t length = used_memory(s);
    for (unsigned k = 0; k < l->count; ++k) {
        const uint64_t start = l->part[k].p_vaddr, end = end_page(&l->part[k], l->page);
        if (s->p_vaddr >= start && s->p_vaddr <= end && length <= end - s->p_vaddr) return true;
    }
    return length == 0;
}

static bool is_followed(Elf64_Word type)
{
    return type == PT_DYNAMIC || type == PT_TLS || type == PT_GNU_RELRO ||
           type == PT_GNU_EH_FRAME || type == PT_PHDR;
}

static bool check_thread_storage(unsigned index, const Elf64_Phdr *s, char *text, size_t size)
{
    return (s->p_filesz <= s->p_memsz && (s->p_align & (s->p_align - 1)) == 0) ||
           refuse(index, text, size, "(thread-local) has %llu bytes of %llu, aligned to %llu",
                  (unsigned long long)s->p_filesz, (unsigned long long)s->p_memsz,
                  (unsigned long long)s->p_align);
}

static bool check_others(elf_file *file, elf_loads *l, unsigned *dynamics, char *text, size_t size)
{
    for (unsigned i = 0; i < file->header.e_phnum; ++i) {
        Elf64_Phdr s;
        if (!elf_file_segment(file, i, &s)) return refuse(i, text, size, "cannot be read");
        const bool read = s.p_type == PT_DYNAMIC || s.p_type == PT_NOTE;
        if (read && !check_in_file(file, i, &s, text, size)) return false;
        if (is_followed(s.p_type) && !is_inside(&s, l))
            return refuse(i, text, size, "(type %#x) lies outside of what is loaded", s.p_type);
        if (s.p_type == PT_TLS && !check_thread_storage(i, &s, text, size)) return false;
        if (s.p_type == PT_TLS) l->thread_bytes = s.p_memsz;
        if (s.p_type == PT_DYNAMIC) l->dynamic = s, *dynamics += 1;
    }
    return true;
}

bool elf_segments_check(elf_file *file, elf_loads *loads, char *text, size_t size)
{
    *loads = (elf_loads){.count = 0, .page = (uint64_t)sysconf(_SC_PAGESIZE)};
    unsigned dynamics = 0;
    if (!read_loads(file, loads, text, size)) return false;
    if (!check_others(file, loads, &dynamics, text, size)) return false;
    if (loads->count > 0 && dynamics == 1) {
        snprintf(text, size, "%u to load, all inside the file", loads->count);
        return true;
    }
    snprintf(text, size, "has %s part",
             loads->count == 0 ? "no loadable"
             : dynamics == 0   ? "no dynamic"
                               : "more than one dynamic");
    return false;
}

const Elf64_Phdr *elf_loads_part(const elf_loads *loads, uint64_t address, uint64_t length)
{
    for (unsigned k = 0; k < loads->count; ++k) {
        const Elf64_Phdr *part = &loads->part[k];
        if (address < part->p_vaddr || address - part->p_vaddr > part->p_memsz) continue;
        if (length <= part->p_memsz - (address - part->p_vaddr)) return part;
    }
    return NULL;
}

bool elf_loads_span(const elf_loads *loads, uint64_t address, uint64_t length)
{
    const uint64_t start = first_page(&loads->part[0], loads->page),
                   end = end_page(&loads->part[loads->count - 1], loads->page);
    return address >= start && address <= end && length <= end - address;
}
