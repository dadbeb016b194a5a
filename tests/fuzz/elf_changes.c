/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/fuzz/elf_changes.h"
#include "tests/fuzz/fuzz.h"

#include <elf.h>
#include <stdint.h>
#include <string.h>

/* --- Fields ----------------------------------------------------------------------------------- */

typedef struct field {
    uint8_t offset, size; /* bytes, in the entry */
} field;

#define FIELD(TYPE, NAME)                                                                          \
    {                                                                                              \
        offsetof(TYPE, NAME), sizeof(((TYPE *)0)->NAME)                                            \
    }

static const field header_fields[] = {
    {EI_CLASS, 1},
    {EI_DATA, 1},
    {EI_VERSION, 1},
    {0, 4},
    FIELD(Elf64_Ehdr, e_type),
    FIELD(Elf64_Ehdr, e_machine),
    FIELD(Elf64_Ehdr, e_entry),
    FIELD(Elf64_Ehdr, e_phoff),
    FIELD(Elf64_Ehdr, e_shoff),
    FIELD(Elf64_Ehdr, e_phentsize),
    FIELD(Elf64_Ehdr, e_phnum),
    FIELD(Elf64_Ehdr, e_shentsize),
    FIELD(Elf64_Ehdr, e_shnum),
    FIELD(Elf64_Ehdr, e_shstrndx),
};
static const field segment_fields[] = {
    FIELD(Elf64_Phdr, p_type),  FIELD(Elf64_Phdr, p_flags), FIELD(Elf64_Phdr, p_offset),
    FIELD(Elf64_Phdr, p_vaddr), FIELD(Elf64_Phdr, p_paddr), FIELD(Elf64_Phdr, p_filesz),
    FIELD(Elf64_Phdr, p_memsz), FIELD(Elf64_Phdr, p_align),
};
static const field section_fields[] = {
    FIELD(Elf64_Shdr, sh_type),
    FIELD(Elf64_Shdr, sh_addr),
    FIELD(Elf64_Shdr, sh_offset),
    FIELD(Elf64_Shdr, sh_size),
};
static const field dynamic_fields[] = {FIELD(Elf64_Dyn, d_tag), FIELD(Elf64_Dyn, d_un)};
static const field relocation_fields[] = {FIELD(Elf64_Rela, r_offset), FIELD(Elf64_Rela, r_info),
                                          FIELD(Elf64_Rela, r_addend)};
static const field symbol_fields[] = {
    FIELD(Elf64_Sym, st_name),  FIELD(Elf64_Sym, st_info), FIELD(Elf64_Sym, st_shndx),
    FIELD(Elf64_Sym, st_value), FIELD(Elf64_Sym, st_size),
};
static const field word_field[] = {{0, 4}};

/* --- Tables ----------------------------------------------------------------------------------- */

typedef struct table {
    const field *fields;
    size_t field_count, entry_size, start, count;
} table;

#define TABLE(FIELDS, ENTRY_SIZE, START, COUNT)                                                    \
    (table) { FIELDS, sizeof FIELDS / sizeof *FIELDS, ENTRY_SIZE, START, COUNT }

static Elf64_Ehdr header_of(elf_image image)
{
    Elf64_Ehdr h;
    FUZZ_REQUIRE(image.length >= sizeof h);
    memcpy(&h, image.at, sizeof h);
    return h;
}

static Elf64_Phdr segment_of(elf_image image, Elf64_Word type)
{
    const Elf64_Ehdr h = header_of(image);
    Elf64_Phdr s = {.p_type = PT_NULL};
    for (size_t k = 0; k < h.e_phnum && s.p_type != type; ++k)
        memcpy(&s, image.at + h.e_phoff + k * sizeof s, sizeof s);
    FUZZ_REQUIRE(s.p_type == type);
    return s;
}

/* A value of the dynamic table. Addresses of tables in the first loaded part, which is only read,
 * are offsets in the file too. */
static size_t dynamic_value(elf_image image, Elf64_Sxword tag)
{
    const Elf64_Phdr s = segment_of(image, PT_DYNAMIC);
    for (size_t at = 0; at + sizeof(Elf64_Dyn) <= s.p_filesz; at += sizeof(Elf64_Dyn)) {
        Elf64_Dyn d;
        memcpy(&d, image.at + s.p_offset + at, sizeof d);
        if (d.d_tag == tag) return d.d_un.d_val;
    }
    return 0;
}

static table table_of(elf_image image, change_part part)
{
    const Elf64_Ehdr h = header_of(image);
    const Elf64_Phdr dynamic = segment_of(image, PT_DYNAMIC), note = segment_of(image, PT_NOTE);
    const size_t symbols = dynamic_value(image, DT_SYMTAB), texts = dynamic_value(image, DT_STRTAB);
    switch (part) {
    case CHANGE_SEGMENT:
        return TABLE(segment_fields, sizeof(Elf64_Phdr), h.e_phoff, h.e_phnum);
    case CHANGE_SECTION:
        return TABLE(section_fields, sizeof(Elf64_Shdr), h.e_shoff, h.e_shnum);
    case CHANGE_DYNAMIC:
        return TABLE(dynamic_fields, sizeof(Elf64_Dyn), dynamic.p_offset,
                     dynamic.p_filesz / sizeof(Elf64_Dyn));
    case CHANGE_RELOCATION:
        return TABLE(relocation_fields, sizeof(Elf64_Rela), dynamic_value(image, DT_RELA),
                     dynamic_value(image, DT_RELASZ) / sizeof(Elf64_Rela));
    case CHANGE_SYMBOL:
        return TABLE(symbol_fields, sizeof(Elf64_Sym), symbols,
                     texts > symbols ? (texts - symbols) / sizeof(Elf64_Sym) : 0);
    case CHANGE_NOTE:
        return TABLE(word_field, 4, note.p_offset, note.p_filesz / 4);
    default:
        return TABLE(header_fields, sizeof h, 0, 1);
    }
}

/* --- Changes ---------------------------------------------------------------------------------- */

static uint64_t value_in(const unsigned char *change)
{
    uint64_t value = 0;
    for (int k = 0; k < 8; ++k) value |= (uint64_t)change[4 + k] << 8 * k;
    return value;
}

static void change_entry(elf_image original, elf_image *image, const unsigned char *change)
{
    const table t = table_of(original, (change_part)(change[1] % CHANGE_PARTS));
    if (t.count == 0) return;
    const field f = t.fields[change[3] % t.field_count];
    const size_t at = t.start + change[2] % t.count * t.entry_size + f.offset;
    uint64_t value = value_in(change), old = 0;
    const size_t other = t.start + value % t.count * t.entry_size + f.offset;
    if (at + f.size > image->length || other + f.size > original.length) return;
    memcpy(&old, image->at + at, f.size);
    switch (change[0] >> 2 & 3) {
    case 1:
        value += old;
        break;
    case 2:
        memcpy(&value, original.at + other, f.size);
        break;
    }
    memcpy(image->at + at, &value, f.size);
}

static void apply(elf_image original, elf_image *image, const unsigned char *change)
{
    const uint64_t value = value_in(change);
    switch (change[1] % CHANGE_PARTS) {
    case CHANGE_BYTE:
        if (image->length > 0) image->at[(value >> 8) % image->length] = (unsigned char)value;
        break;
    case CHANGE_LENGTH:
        if (value < image->length) image->length = (size_t)value;
        break;
    default:
        change_entry(original, image, change);
    }
}

elf_image elf_changed(elf_image original, unsigned file, const unsigned char *bytes, size_t length)
{
    elf_image image = {malloc(original.length), original.length};
    FUZZ_REQUIRE(image.at != NULL);
    memcpy(image.at, original.at, original.length);
    for (size_t k = 0; k + CHANGE_BYTES <= length; k += CHANGE_BYTES)
        if ((bytes[k] & 3u) % CHANGED_FILES == file) apply(original, &image, bytes + k);
    return image;
}

/* --- Mutation --------------------------------------------------------------------------------- */

static unsigned draw(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

/* Sizes, addresses and tags that loaders compare, and differences that move across a page. */
static uint64_t draw_value(unsigned *state)
{
    static const uint64_t values[] = {0,
                                      1,
                                      2,
                                      3,
                                      4,
                                      7,
                                      8,
                                      16,
                                      24,
                                      56,
                                      64,
                                      0xfff,
                                      0x1000,
                                      0x1001,
                                      0x2000,
                                      0x10000,
                                      0x200000,
                                      0x7fffffff,
                                      1u << 31,
                                      0xffffffff,
                                      (uint64_t)1 << 32,
                                      (uint64_t)1 << 47,
                                      INT64_MAX,
                                      (uint64_t)1 << 63,
                                      (uint64_t)-1,
                                      (uint64_t)-8,
                                      (uint64_t)-16,
                                      (uint64_t)-0x1000,
                                      DT_INIT,
                                      DT_FINI_ARRAY,
                                      DT_TEXTREL,
                                      DT_JMPREL,
                                      PT_GNU_STACK,
                                      PT_TLS,
                                      PT_INTERP,
                                      PT_PHDR};
    const unsigned kind = draw(state) % 4;
    if (kind == 0) return draw(state) % 0x8000;
    if (kind == 1) return (uint64_t)draw(state) << draw(state) % 40;
    return values[draw(state) % (sizeof values / sizeof *values)];
}

static void draw_change(unsigned *state, unsigned char *change)
{
    const uint64_t value = draw_value(state);
    change[0] = (unsigned char)(draw(state) % 12); /* file 0 to 3; set, add or copy */
    change[1] = (unsigned char)(draw(state) % CHANGE_PARTS);
    change[2] = (unsigned char)draw(state);
    change[3] = (unsigned char)draw(state);
    for (int k = 0; k < 8; ++k) change[4 + k] = (unsigned char)(value >> 8 * k);
}

size_t elf_mutate(unsigned char *bytes, size_t length, size_t max_length, unsigned seed)
{
    unsigned state = seed;
    size_t count = length / CHANGE_BYTES;
    const size_t last = max_length / CHANGE_BYTES;
    if (last == 0) return length;
    if (count > last) count = last;
    size_t k = draw(&state) % (count + 1);
    if (k == count && count == last) k = last - 1;
    if (k < count && draw(&state) % 4 == 0) { /* one less */
        memmove(bytes + k * CHANGE_BYTES, bytes + (k + 1) * CHANGE_BYTES,
                (count - k - 1) * CHANGE_BYTES);
        return (count - 1) * CHANGE_BYTES;
    }
    unsigned char *change = bytes + k * CHANGE_BYTES, fresh[CHANGE_BYTES];
    draw_change(&state, fresh);
    if (k < count && draw(&state) % 2 == 0)
        memcpy(change + 4, fresh + 4, 8); /* another value for the same field */
    else
        memcpy(change, fresh, CHANGE_BYTES);
    return (k < count ? count : count + 1) * CHANGE_BYTES;
}
