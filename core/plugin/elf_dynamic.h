/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_DYNAMIC_H
#define CORE_PLUGIN_ELF_DYNAMIC_H

#include "core/plugin/elf_segments.h"

/* The dynamic table of a shared object, and its memory before anything is relocated. */

enum { ELF_DYNAMIC_MAX = 512 }; /* entries; usual are 30 */

typedef struct elf_dynamic {
    elf_file *file;
    const elf_loads *loads;
    Elf64_Dyn entry[ELF_DYNAMIC_MAX];
    unsigned count;
} elf_dynamic;

/* False: it does not end inside the file, or is too long. */
bool elf_dynamic_open(elf_dynamic *d, elf_file *file, const elf_loads *loads);

/* The value of the last entry with that tag, which is the one that counts; false: there is none. */
bool elf_dynamic_find(const elf_dynamic *d, Elf64_Sxword tag, uint64_t *value);

/* Whether the file has the bytes that are loaded at that address. */
bool elf_dynamic_has(const elf_dynamic *d, uint64_t address, uint64_t length);

/* Reads the bytes that are loaded at that address. False: the file does not have them. */
bool elf_dynamic_load(const elf_dynamic *d, uint64_t address, void *to, size_t length);

#endif
