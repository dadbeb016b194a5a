/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_FUZZ_ELF_CHANGES_H
#define TESTS_FUZZ_ELF_CHANGES_H

#include <stddef.h>

/* Changes of the fields of an ELF file
 * ====================================
 * An input is a list of changes, CHANGE_BYTES each:
 *
 *   file   which of the files, beside what is done (bits 2 and 3): set the field, add to it, copy
 *          it from the entry `value` of the same table
 *   part   of the file: see change_part
 *   index  of the entry in its table, modulo the number there are
 *   field  of the entry, modulo the number of its fields
 *   value  8 bytes, lowest first
 *
 * Tables and entries are found in the unchanged file, so that the order of changes does not matter
 * much. A file is read as 64 bits, little-endian, as all machines have it that this runs on. */

enum { CHANGE_BYTES = 12, CHANGED_FILES = 2 };

typedef enum change_part {
    CHANGE_HEADER,     /* of the file; one entry */
    CHANGE_SEGMENT,    /* program headers */
    CHANGE_SECTION,    /* section headers */
    CHANGE_DYNAMIC,    /* the dynamic table */
    CHANGE_RELOCATION, /* DT_RELA */
    CHANGE_SYMBOL,     /* DT_SYMTAB */
    CHANGE_NOTE,       /* bytes of the first PT_NOTE */
    CHANGE_BYTE,       /* the byte at `value` / 256 */
    CHANGE_LENGTH,     /* the file is cut to `value` bytes */
    CHANGE_PARTS
} change_part;

typedef struct elf_image {
    unsigned char *at;
    size_t length;
} elf_image;

/* Makes the changes of the list that concern a file in a copy of it, which the caller frees. */
elf_image elf_changed(elf_image original, unsigned file, const unsigned char *bytes, size_t length);

/* Replaces or adds one change: fields by values that matter to a loader. Answers the new length. */
size_t elf_mutate(unsigned char *bytes, size_t length, size_t max_length, unsigned seed);

#endif
