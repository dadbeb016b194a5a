/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_probe.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

#include <elf.h>

/* A good plugin whose tables are changed so that a loader would be led out of it. Tables of a
 * plugin that are only read lie in its first part, where addresses are offsets in the file. */

static sandbox_bytes plugin;

static void read_plugin(void) { plugin = sandbox_read(sandbox_plugin("kit").at); }
static void free_plugin(void) { free(plugin.at); }

static elf_probe probe(void)
{
    sandbox box = sandbox_new();
    sandbox_write(&box, "p.so", plugin.at, plugin.length);
    elf_probe found;
    elf_probe_file(sandbox_file(&box, "p.so").at, false, &found);
    sandbox_remove(&box);
    return found;
}

/* With `length` bytes at `offset` replaced for once. */
static void assert_refused(size_t offset, uint64_t value, size_t length, const char *text)
{
    unsigned char before[8];
    ck_assert_uint_le(offset + length, plugin.length);
    memcpy(before, plugin.at + offset, length);
    memcpy(plugin.at + offset, &value, length);
    const elf_probe found = probe();
    memcpy(plugin.at + offset, before, length);
    ck_assert_ptr_eq(elf_probe_refusal(&found), &found.check[PROBE_TABLES]);
    ck_assert_msg(strstr(found.check[PROBE_TABLES].text, text) != NULL, "%s: %s", text,
                  found.check[PROBE_TABLES].text);
}

static Elf64_Phdr segment_of(Elf64_Word type)
{
    Elf64_Ehdr header;
    Elf64_Phdr segment;
    memcpy(&header, plugin.at, sizeof header);
    for (size_t k = 0; k < header.e_phnum; ++k) {
        memcpy(&segment, plugin.at + header.e_phoff + k * sizeof segment, sizeof segment);
        if (segment.p_type == type) return segment;
    }
    ck_abort_msg("no segment of type %u", type);
    return segment;
}

/* The offset of the first dynamic entry with that tag. */
static size_t entry_of(Elf64_Sxword tag)
{
    const Elf64_Phdr dynamic = segment_of(PT_DYNAMIC);
    for (size_t at = dynamic.p_offset; at < dynamic.p_offset + dynamic.p_filesz;
         at += sizeof(Elf64_Dyn)) {
        Elf64_Sxword found;
        memcpy(&found, plugin.at + at, sizeof found);
        if (found == tag) return at;
    }
    ck_abort_msg("no dynamic entry %llx", (unsigned long long)tag);
    return 0;
}

static size_t value_at(Elf64_Sxword tag) { return entry_of(tag) + offsetof(Elf64_Dyn, d_un); }

static uint64_t value_of(Elf64_Sxword tag)
{
    uint64_t value;
    memcpy(&value, plugin.at + value_at(tag), sizeof value);
    return value;
}

static const uint64_t far = (uint64_t)1 << 40;

START_TEST(strings_and_names_must_be_there)
{
    assert_refused(value_at(DT_STRSZ), far, 8, "strings lie outside");
    assert_refused(value_at(DT_STRTAB), far, 8, "strings lie outside");
    assert_refused(value_at(DT_STRSZ), value_of(DT_STRSZ) - 1, 8, "strings do not end");
    assert_refused(value_at(DT_NEEDED), value_of(DT_STRSZ), 8, "the name of a dynamic entry");
    assert_refused(value_of(DT_SYMTAB) + sizeof(Elf64_Sym), 0xffffff, 4, "the name of a symbol");
}
END_TEST

START_TEST(hashes_must_lead_to_symbols_that_are_there)
{
    const uint64_t hash = value_of(DT_GNU_HASH);
    Elf64_Word head[4], symbol = 0;
    memcpy(head, plugin.at + hash, sizeof head);
    const size_t buckets = hash + sizeof head + 8 * head[2];
    size_t bucket = buckets;
    for (; symbol == 0; bucket += 4) memcpy(&symbol, plugin.at + bucket, sizeof symbol);
    const char *text = "hashes leads out";
    assert_refused(value_at(DT_GNU_HASH), far, 8, text);
    assert_refused(hash, 0, 4, text);
    assert_refused(hash, 1 << 30, 4, text);
    assert_refused(hash + 8, 3, 4, text);
    assert_refused(bucket - 4, 0xffffff, 4, text);
    assert_refused(bucket - 4, head[1] - 1, 4, text);
    assert_refused(value_at(DT_SYMTAB), far, 8, "symbols lie outside");
    assert_refused(value_of(DT_SYMTAB) + symbol * sizeof(Elf64_Sym) + offsetof(Elf64_Sym, st_value),
                   far, 8, "lies outside of what is loaded");
    assert_refused(value_of(DT_SYMTAB) + symbol * sizeof(Elf64_Sym) + offsetof(Elf64_Sym, st_size),
                   far, 8, "lies outside of what is loaded");
}
END_TEST

START_TEST(versions_must_be_declared)
{
    const uint64_t needed = value_of(DT_VERNEED);
    const char *text = "versions lead out";
    Elf64_Verneed first;
    memcpy(&first, plugin.at + needed, sizeof first);
    assert_refused(value_at(DT_VERNEED), far, 8, text);
    assert_refused(needed + offsetof(Elf64_Verneed, vn_file), 0xffffff, 4, "a needed file");
    assert_refused(needed + offsetof(Elf64_Verneed, vn_aux), 0xffffff, 4, text);
    assert_refused(needed + offsetof(Elf64_Verneed, vn_next), 0xffffff, 4, text);
    const size_t version = needed + first.vn_aux;
    assert_refused(version + offsetof(Elf64_Vernaux, vna_name), 0xffffff, 4, "a version");
    assert_refused(version + offsetof(Elf64_Vernaux, vna_next), 0xffffff, 4, text);
    assert_refused(value_of(DT_VERSYM) + 2, 77, 2, "has version 77");
    assert_refused(value_at(DT_VERSYM), far, 8, "versions of its symbols lie outside");
}
END_TEST

/* The offset of the first relocation whose place is in [start, start + length). */
static size_t relocation_of(uint64_t start, uint64_t length)
{
    const uint64_t from = value_of(DT_RELA), size = value_of(DT_RELASZ);
    for (size_t at = from; at < from + size; at += sizeof(Elf64_Rela)) {
        uint64_t place;
        memcpy(&place, plugin.at + at, sizeof place);
        if (place >= start && place - start < length) return at;
    }
    ck_abort_msg("nothing is relocated there");
    return 0;
}

START_TEST(relocations_must_stay_inside)
{
    const size_t any = relocation_of(value_of(DT_FINI_ARRAY) + value_of(DT_FINI_ARRAYSZ), far),
                 addend = offsetof(Elf64_Rela, r_addend),
                 called = relocation_of(value_of(DT_INIT_ARRAY), value_of(DT_INIT_ARRAYSZ));
    assert_refused(value_at(DT_RELA), far, 8, "relocations lie outside");
    assert_refused(value_at(DT_RELASZ), far, 8, "relocation");
    assert_refused(any, far, 8, "not the object's to write");
    assert_refused(any, 0, 8, "not the object's to write");
    assert_refused(any + addend, far, 8, "outside of what is loaded");
    assert_refused(any + addend, (uint64_t)-0x10000, 8, "outside of what is loaded");
    assert_refused(called + addend, 0, 8, "outside of what is loaded");
    assert_refused(any + offsetof(Elf64_Rela, r_info) + 4, 0xffffff, 4, "is of symbol 16777215");
#if defined(__x86_64__)
    memset(plugin.at + value_at(DT_RELACOUNT), 0, 8);
    assert_refused(any + offsetof(Elf64_Rela, r_info), R_X86_64_COPY, 4, "copies");
    assert_refused(any + offsetof(Elf64_Rela, r_info), R_X86_64_IRELATIVE, 4, "resolver");
#endif
    assert_refused(value_at(DT_RELAENT), 8, 8, "is 8, expected 24");
    assert_refused(value_at(DT_INIT_ARRAY), far, 8, "constructors or destructors");
    assert_refused(value_at(DT_FINI_ARRAYSZ), far, 8, "constructors or destructors");
}
END_TEST

/* Relocations are packed as by `-z pack-relative-relocs`: their table lies over the unwinding
 * table, which the probe does not read; two entries that a plugin can do without point to it. The
 * first words of the global offset table are not relocated otherwise. */
START_TEST(packed_relocations_must_stay_inside)
{
    const Elf64_Phdr unwinding = segment_of(PT_GNU_EH_FRAME), dynamic = segment_of(PT_DYNAMIC);
    const uint64_t got = value_of(DT_PLTGOT), words[2] = {got, 3};
    const Elf64_Dyn table = {DT_RELR, {unwinding.p_vaddr}}, size = {DT_RELRSZ, {sizeof words}};
    memcpy(plugin.at + entry_of(DT_SONAME), &table, sizeof table);
    memcpy(plugin.at + entry_of(DT_NEEDED), &size, sizeof size);
    memcpy(plugin.at + unwinding.p_offset, words, sizeof words);
    const elf_probe found = probe();
    ck_assert_msg(elf_probe_refusal(&found) == NULL, "%s", elf_probe_refusal(&found)->text);
    assert_refused(unwinding.p_offset, far, 8, "not the object's to write");
    assert_refused(unwinding.p_offset, 3, 8, "not the object's to write");
    assert_refused(unwinding.p_offset, dynamic.p_vaddr + 8, 8, "in the dynamic table");
    assert_refused(unwinding.p_offset + 8, got, 8, "two relocations write");
    assert_refused(got + 8 - dynamic.p_vaddr + dynamic.p_offset, far, 8,
                   "refers to 0x10000000000, outside");
}
END_TEST

/* The offset of the first relocation to code that nothing calls when the object is loaded. */
static size_t relocation_to_code(void)
{
    const uint64_t calls = value_of(DT_FINI_ARRAY) + value_of(DT_FINI_ARRAYSZ),
                   code = value_of(DT_INIT), end = value_of(DT_FINI);
    size_t at = relocation_of(calls, far);
    for (uint64_t target = 0; target < code || target >= end; at += sizeof(Elf64_Rela))
        memcpy(&target, plugin.at + at + offsetof(Elf64_Rela, r_addend), sizeof target);
    return at - sizeof(Elf64_Rela);
}

/* The first case makes a surface's function a constructor, which overwrites the environment. */
START_TEST(relocations_write_no_byte_twice)
{
    const uint64_t array = value_of(DT_INIT_ARRAY);
    const size_t any = relocation_to_code();
    uint64_t place;
    memcpy(&place, plugin.at + any + sizeof(Elf64_Rela), sizeof place);
    assert_refused(any, array, 8, "two relocations write");
    assert_refused(any, array + 4, 8, "two relocations write");
    assert_refused(any, place, 8, "two relocations write");
    assert_refused(any, place - 1, 8, "two relocations write");
    assert_refused(any, segment_of(PT_DYNAMIC).p_vaddr + 8, 8, "in the dynamic table");
}
END_TEST

START_TEST(what_is_called_is_code_of_the_object)
{
#if defined(__x86_64__)
    const size_t called = relocation_of(value_of(DT_INIT_ARRAY), value_of(DT_INIT_ARRAYSZ)),
                 kind = called + offsetof(Elf64_Rela, r_info);
    assert_refused(kind, (uint64_t)1 << 32 | R_X86_64_64, 8, "is not relative, the first");
    assert_refused(value_at(DT_RELACOUNT), 1 << 20, 8, "is not relative, the first");
    memset(plugin.at + value_at(DT_RELACOUNT), 0, 8);
    assert_refused(kind, R_X86_64_NONE, 4, "are relocated, of");
    assert_refused(kind, R_X86_64_IRELATIVE, 4, "call what is not its own code");
    assert_refused(kind, R_X86_64_DTPMOD64, 4, "call what is not its own code");
    assert_refused(kind, R_X86_64_PC32, 4, "call what is not its own code");
    assert_refused(called, value_of(DT_INIT_ARRAY) - 4, 8, "relocat");
#endif
    assert_refused(value_at(DT_FINI_ARRAYSZ), value_of(DT_FINI_ARRAYSZ) + 8, 8, "relocat");
}
END_TEST

/* The offset of a program header that a plugin can do without. */
static size_t spare_header(void)
{
    Elf64_Ehdr header;
    Elf64_Word type = PT_NULL;
    memcpy(&header, plugin.at, sizeof header);
    size_t at = header.e_phoff - sizeof(Elf64_Phdr);
    while (type != PT_GNU_STACK) memcpy(&type, plugin.at + (at += sizeof(Elf64_Phdr)), sizeof type);
    return at;
}

/* A program header becomes one of 16 bytes for each thread. */
START_TEST(offsets_in_a_thread_must_stay_inside)
{
#if defined(__x86_64__)
    const size_t at = spare_header();
    const Elf64_Phdr thread = {.p_type = PT_TLS, .p_memsz = 16, .p_align = 8};
    const size_t any = relocation_to_code();
    const uint64_t kind = R_X86_64_DTPOFF64, last = 16;
    memcpy(plugin.at + at, &thread, sizeof thread);
    memset(plugin.at + value_at(DT_RELACOUNT), 0, 8);
    memcpy(plugin.at + any + offsetof(Elf64_Rela, r_info), &kind, sizeof kind);
    memcpy(plugin.at + any + offsetof(Elf64_Rela, r_addend), &last, sizeof last);
    const elf_probe good = probe();
    ck_assert_msg(elf_probe_refusal(&good) == NULL, "%s", elf_probe_refusal(&good)->text);
    assert_refused(any + offsetof(Elf64_Rela, r_addend), 17, 8, "byte 17 of 16 of a thread");
    assert_refused(any + offsetof(Elf64_Rela, r_addend), far, 8, "of 16 of a thread");
    const uint64_t more = 17, odd = 3;
    memcpy(plugin.at + at + offsetof(Elf64_Phdr, p_align), &odd, sizeof odd);
    elf_probe found = probe();
    ck_assert_ptr_eq(elf_probe_refusal(&found), &found.check[PROBE_SEGMENTS]);
    memcpy(plugin.at + at, &thread, sizeof thread);
    memcpy(plugin.at + at + offsetof(Elf64_Phdr, p_filesz), &more, sizeof more);
    found = probe();
    ck_assert_ptr_eq(elf_probe_refusal(&found), &found.check[PROBE_SEGMENTS]);
#endif
}
END_TEST

START_TEST(there_is_one_dynamic_table)
{
    const Elf64_Phdr dynamic = segment_of(PT_DYNAMIC);
    memcpy(plugin.at + spare_header(), &dynamic, sizeof dynamic);
    const elf_probe found = probe();
    ck_assert_ptr_eq(elf_probe_refusal(&found), &found.check[PROBE_SEGMENTS]);
    ck_assert_str_eq(found.check[PROBE_SEGMENTS].text,
                     "has more than one dynamic part; the file is damaged or cut short; build or "
                     "copy it again");
}
END_TEST

START_TEST(tables_of_a_file_that_was_tried_are_not_checked_again)
{
    memset(plugin.at + value_at(DT_STRSZ), 0xff, 8);
    sandbox box = sandbox_new();
    sandbox_write(&box, "p.so", plugin.at, plugin.length);
    const sandbox_path path = sandbox_file(&box, "p.so");
    elf_probe found;
    ck_assert(!elf_probe_file(path.at, false, &found));
    ck_assert_int_eq(found.check[PROBE_TABLES].verdict, PROBE_REFUSED);
    ck_assert(elf_probe_tried(path.at, &found));
    ck_assert_str_eq(found.name, "kit");
    plugin.length /= 2; /* what is cut short is refused all the same */
    sandbox_write(&box, "p.so", plugin.at, plugin.length);
    ck_assert(!elf_probe_tried(path.at, &found));
    sandbox_remove(&box);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {strings_and_names_must_be_there,
                                  hashes_must_lead_to_symbols_that_are_there,
                                  versions_must_be_declared,
                                  relocations_must_stay_inside,
                                  packed_relocations_must_stay_inside,
                                  relocations_write_no_byte_twice,
                                  what_is_called_is_code_of_the_object,
                                  offsets_in_a_thread_must_stay_inside,
                                  there_is_one_dynamic_table,
                                  tables_of_a_file_that_was_tried_are_not_checked_again};
    return suite_main_with("elf_tables", tests, sizeof tests / sizeof tests[0], read_plugin,
                           free_plugin);
}
