/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_FILE_H
#define CORE_PLUGIN_ELF_FILE_H

#include <elf.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reading an untrusted ELF file
 * ===========================================
 * Offsets and lengths come from the file, so each read is checked against the file's size, without
 * overflow, and done by pread: a missing part is reported, never signalled.
 * Only files of this machine's word size and byte order make sense here. */

enum { ELF_BLOCK = 4096 }; /* bytes */

typedef struct elf_block {
    uint64_t start;  /* in the file, bytes */
    uint64_t length; /* bytes that are held */
    unsigned char bytes[ELF_BLOCK];
} elf_block;

typedef struct elf_file {
    int fd;
    uint64_t size; /* bytes */
    Elf64_Ehdr header;
    bool lacks_memory;   /* a check was refused for lack of memory alone */
    elf_block blocks[2]; /* read last: walks over a table look at another by turns */
    unsigned recent;     /* of blocks, the one that was used last */
} elf_file;

/* Bytes of a file. Length 0: not found. */
typedef struct elf_span {
    uint64_t offset, length;
} elf_span;

/* True if the bytes [offset, offset + length) are in the file. */
bool elf_file_has(const elf_file *file, uint64_t offset, uint64_t length);

/* Reads exactly `length` bytes; false if the file does not have them (any more). */
bool elf_file_read(elf_file *file, uint64_t offset, void *buffer, size_t length);

/* Reads a program header; index < header.e_phnum. */
bool elf_file_segment(elf_file *file, unsigned index, Elf64_Phdr *segment);

/* The descriptor of the first note of that owner and type in any note segment. */
elf_span elf_file_find_note(elf_file *file, const char *owner, uint32_t type);

/* Name the file's kind in words: "64-bit", "little-endian", "x86-64". */
const char *elf_class_name(unsigned char class);
const char *elf_order_name(unsigned char order);
const char *elf_machine_name(Elf64_Half machine);

#endif
