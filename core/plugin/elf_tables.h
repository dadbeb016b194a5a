/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_TABLES_H
#define CORE_PLUGIN_ELF_TABLES_H

#include "core/plugin/elf_segments.h"

/* Whether what the dynamic loader follows stays inside the object
 * ================================================================
 * The loader believes the tables that the dynamic table points to. What leads out of the object may
 * meet nothing in one process and other memory in the next, so that loading it for trial shows
 * little: of 225 damaged files that only this check refuses, 4 pass the trial and crash the host,
 * and 2 make the loading of good files crash. Accepted is a file where
 *
 *   - strings end inside the table of strings, and every name begins there;
 *   - the table of hashes leads to symbols that are there, each of whose versions is declared;
 *   - symbols, and what is relocated relative to the object, lie in its memory, or in its
 *     thread-local storage;
 *   - relocations write to memory that may be written, no byte twice and none of the dynamic table
 *     (elf_places.c has the lemma), of symbols that are there;
 *   - constructors, destructors and resolvers lie in code, and words that name them are relocated.
 *
 * What code does is not examined. False: `text` says which table is wrong. */
bool elf_tables_check(elf_file *file, const elf_loads *loads, char *text, size_t size);

/* The file among those it needs that is the runtime of AddressSanitizer or ThreadSanitizer, as
 * libasan.so.8; empty: none. Of tables that elf_tables_check accepts. */
typedef struct elf_runtime {
    char name[32];
} elf_runtime;
elf_runtime elf_tables_runtime(elf_file *file, const elf_loads *loads);

#endif
