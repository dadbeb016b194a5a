/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_dynamic.h"

bool elf_dynamic_open(elf_dynamic *d, elf_file *file, const elf_loads *loads)
{
    d->file = file, d->loads = loads;
    d->count = 0;
    for (uint64_t at = loads->dynamic.p_vaddr; d->count < ELF_DYNAMIC_MAX;
         at += sizeof(Elf64_Dyn)) {
        if (!elf_dynamic_load(d, at, &d->entry[d->count], sizeof(Elf64_Dyn))) return false;
        if (d->entry[d->count].d_tag == DT_NULL) return true;
        d->count += 1;
    }
    return false;
}

bool elf_dynamic_find(const elf_dynamic *d, Elf64_Sxword tag, uint64_t *value)
{
    *value = 0;
    for (unsigned k = d->count; k-- > 0;) {
        if (d->entry[k].d_tag != tag) continue;
        *value = d->entry[k].d_un.d_val;
        return true;
    }
    return false;
}

/* Where in the file the bytes are that are loaded there; false: not all of them are in it. */
static bool find_offset(const elf_dynamic *d, uint64_t address, uint64_t length, uint64_t *offset)
{
    const Elf64_Phdr *part = elf_loads_part(d->loads, address, length);
    if (part == NULL) return false;
    const uint64_t within = address - part->p_vaddr;
    *offset = part->p_offset + within;
    return within <= part->p_filesz && length <= part->p_filesz - within;
}

bool elf_dynamic_has(const elf_dynamic *d, uint64_t address, uint64_t length)
{
    uint64_t offset;
    return find_offset(d, address, length, &offset);
}

bool elf_dynamic_load(const elf_dynamic *d, uint64_t address, void *to, size_t length)
{
    uint64_t offset;
    return find_offset(d, address, length, &offset) && elf_file_read(d->file, offset, to, length);
}
