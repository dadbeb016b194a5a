/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_SEGMENTS_H
#define CORE_PLUGIN_ELF_SEGMENTS_H

#include "core/plugin/elf_file.h"

/* Whether the program headers keep the dynamic loader inside the object
 * =====================================================================
 * The loader reserves memory from the first PT_LOAD to the last one, maps each at its place without
 * asking whether something else is there, and then follows the other headers. So it destroys what
 * lies beside the object, in this process, if a header points out of it. Accepted is a file where
 *
 *   - every PT_LOAD has its bytes in the file (touching a page past its end raises SIGBUS), is not
 *     larger there than in memory, does not wrap around, and is aligned as the loader wants it;
 *   - PT_LOADs ascend, and no two share a page of memory;
 *   - what the loader reads, writes or protects besides (PT_DYNAMIC, PT_TLS, PT_GNU_RELRO,
 *     PT_GNU_EH_FRAME, PT_PHDR) lies inside a PT_LOAD;
 *   - thread-local storage has room for its bytes in the file, and a power of two for alignment;
 *   - there is one PT_DYNAMIC.
 *
 * Addresses are those in the file, to which the loader adds where it put the object. */

enum { ELF_LOADS_MAX = 32 }; /* usual are 2 to 6 */

typedef struct elf_loads {
    Elf64_Phdr part[ELF_LOADS_MAX]; /* PT_LOAD; ascending */
    Elf64_Phdr dynamic;             /* PT_DYNAMIC */
    unsigned count;
    uint64_t page;         /* bytes */
    uint64_t thread_bytes; /* of thread-local storage */
} elf_loads;

/* False: `text` says which header is wrong. */
bool elf_segments_check(elf_file *file, elf_loads *loads, char *text, size_t size);

/* The part whose memory has all these bytes, or NULL. */
const Elf64_Phdr *elf_loads_part(const elf_loads *loads, uint64_t address, uint64_t length);

/* Whether the memory that the loader reserves, from the first page of the first part to the last
 * one of the last, has all these bytes; its end counts as inside where there are none. */
bool elf_loads_span(const elf_loads *loads, uint64_t address, uint64_t length);

#endif
