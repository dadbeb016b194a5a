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
 *     PT_GNU_EH_FRAME, PT_PHDR) lies inside a PT_LOAD.
 *
 * False: `text` says which header is wrong. */
bool elf_segments_check(const elf_file *file, char *text, size_t size);

#endif
