/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ELF_TABLES_INTERNAL_H
#define CORE_PLUGIN_ELF_TABLES_INTERNAL_H

#include "core/plugin/elf_dynamic.h"

/* What the files behind elf_tables_check share: elf_tables.c finds the strings, elf_symbols.c
 * counts and checks the symbols, elf_relocations.c checks what refers to them, elf_places.c where
 * relocations write. All answer false after elf_refuse. */

/* Bytes that a relocation writes. */
typedef struct elf_place {
    uint64_t at, length;
} elf_place;

typedef struct elf_places {
    elf_place *place; /* freed by elf_tables_check */
    size_t count, room;
} elf_places;

typedef struct elf_object {
    elf_dynamic d;
    uint64_t string_bytes;
    uint64_t symbols, symbol_count; /* address; 0 is no symbol */
    unsigned last_version;          /* that is declared */
    uint64_t called[2][2];          /* constructors and destructors: address, bytes of words */
    Elf64_Word written;             /* the flag of parts that relocations may write to */
    elf_places places;
    char *text; /* why it is refused */
    size_t size;
} elf_object;

__attribute__((format(printf, 2, 3))) bool elf_refuse(elf_object *o, const char *format, ...);

/* Whether `length` bytes lie in one part that has this flag (PF_X, PF_W). */
bool elf_is_in_part(const elf_object *o, uint64_t address, uint64_t length, Elf64_Word flag);
bool elf_is_code(const elf_object *o, uint64_t address);

bool elf_check_name(elf_object *o, uint64_t name, const char *whose);

bool elf_symbol_load(elf_object *o, uint64_t k, Elf64_Sym *symbol);

/* Whether it is an address in the object. */
bool elf_symbol_is_placed(const Elf64_Sym *s);

/* Whether it is an offset in the object's thread-local storage. */
bool elf_symbol_is_of_thread(const Elf64_Sym *s);

/* Keeps a place that a relocation writes. False: it is not the object's to write, part of the
 * dynamic table, or more than the file has room for. */
bool elf_places_add(elf_object *o, uint64_t at, uint64_t length);

/* Whether a word that is called when the object is loaded or unloaded has one of these bytes. */
bool elf_places_are_called(const elf_object *o, uint64_t at, uint64_t length);

/* Checks that no byte is written twice and, if the machine's relocation types are known
 * (`is_exact`), that each word of the init and fini arrays is written. */
bool elf_places_check(elf_object *o, bool is_exact);

bool elf_symbols_check(elf_object *o);
bool elf_relocations_check(elf_object *o);

/* One more than the last symbol that is relocated; at least 1. */
uint64_t elf_relocations_symbols(elf_object *o);

#endif
