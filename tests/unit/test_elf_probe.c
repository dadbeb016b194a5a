/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_probe.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

#include <elf.h>

#include <impinge/surface.h>

/* Probes these bytes as a file. */
static elf_probe probe_bytes(const void *bytes, size_t length, bool all)
{
    sandbox box = sandbox_new();
    sandbox_write(&box, "p.so", bytes, length);
    elf_probe probe;
    bool passed = elf_probe_file(sandbox_file(&box, "p.so").at, all, &probe);
    ck_assert(passed == (elf_probe_refusal(&probe) == NULL));
    sandbox_remove(&box);
    return probe;
}

static sandbox_bytes good_plugin(void) { return sandbox_read(sandbox_plugin("kit").at); }

static void assert_refused_by(const elf_probe *probe, elf_check_id id, const char *text)
{
    const elf_check *refusal = elf_probe_refusal(probe);
    ck_assert_ptr_eq(refusal, &probe->check[id]);
    ck_assert_msg(strstr(refusal->text, text) != NULL, "%s: %s", refusal->name, refusal->text);
}

/* A good plugin with `length` bytes at `offset` replaced. */
static elf_probe probe_patched(size_t offset, const void *bytes, size_t length)
{
    sandbox_bytes plugin = good_plugin();
    memcpy(plugin.at + offset, bytes, length);
    elf_probe probe = probe_bytes(plugin.at, plugin.length, false);
    free(plugin.at);
    return probe;
}

START_TEST(a_good_plugin_passes_every_check_and_tells_its_note)
{
    elf_probe probe;
    ck_assert(elf_probe_file(sandbox_plugin("kit").at, true, &probe));
    for (int id = 0; id < PROBE_CHECKS; ++id) {
        ck_assert_int_eq(probe.check[id].verdict, PROBE_PASSED);
        ck_assert_str_ne(probe.check[id].name, "");
        ck_assert_str_ne(probe.check[id].text, "");
    }
    ck_assert_str_eq(probe.name, "kit");
    ck_assert_str_eq(probe.version, "1.0");
    ck_assert_uint_eq(probe.abi_major, IMP_ABI_MAJOR);
    ck_assert_uint_eq(probe.abi_minor, IMP_ABI_MINOR);
    ck_assert_uint_gt(probe.file.inode, 0);
}
END_TEST

START_TEST(a_missing_file_a_directory_and_a_pipe_are_refused_at_once)
{
    sandbox box = sandbox_new();
    elf_probe probe;
    ck_assert(!elf_probe_file(sandbox_file(&box, "missing").at, true, &probe));
    assert_refused_by(&probe, PROBE_FILE, "No such file");
    ck_assert_int_eq(probe.check[PROBE_FORMAT].verdict, PROBE_NOT_REACHED);
    ck_assert(!elf_probe_file(box.path, true, &probe));
    assert_refused_by(&probe, PROBE_FILE, "directory");
    ck_assert_int_eq(mkfifo(sandbox_file(&box, "pipe").at, 0600), 0);
    ck_assert(!elf_probe_file(sandbox_file(&box, "pipe").at, true, &probe));
    assert_refused_by(&probe, PROBE_FILE, "pipe");
    sandbox_remove(&box);
}
END_TEST

START_TEST(text_and_nothing_are_no_elf_files)
{
    elf_probe probe = probe_bytes("#!/bin/sh\n", 10, true);
    assert_refused_by(&probe, PROBE_FORMAT, "not an ELF file");
    probe = probe_bytes("", 0, true);
    assert_refused_by(&probe, PROBE_FORMAT, "not an ELF file");
}
END_TEST

START_TEST(foreign_machines_classes_and_orders_are_named)
{
    const Elf64_Half machine = EM_S390, arm = EM_ARM;
    elf_probe probe = probe_patched(offsetof(Elf64_Ehdr, e_machine), &machine, 2);
    assert_refused_by(&probe, PROBE_MACHINE, "is for s390");
    probe = probe_patched(offsetof(Elf64_Ehdr, e_machine), &arm, 2);
    assert_refused_by(&probe, PROBE_MACHINE, "is for arm");
    probe = probe_patched(EI_CLASS, &(char){ELFCLASS32}, 1);
    assert_refused_by(&probe, PROBE_CLASS, "32-bit");
    sandbox_bytes plugin = good_plugin();
    char other = plugin.at[EI_DATA] == ELFDATA2LSB ? ELFDATA2MSB : ELFDATA2LSB;
    free(plugin.at);
    probe = probe_patched(EI_DATA, &other, 1);
    assert_refused_by(&probe, PROBE_CLASS, "endian");
}
END_TEST

START_TEST(object_files_and_programs_are_not_shared_objects)
{
    elf_probe probe = probe_patched(offsetof(Elf64_Ehdr, e_type), &(Elf64_Half){ET_REL}, 2);
    assert_refused_by(&probe, PROBE_KIND, "not linked");
    probe = probe_patched(offsetof(Elf64_Ehdr, e_type), &(Elf64_Half){ET_EXEC}, 2);
    assert_refused_by(&probe, PROBE_KIND, "a program");
}
END_TEST

START_TEST(a_plugin_cut_short_anywhere_is_refused)
{
    sandbox_bytes plugin = good_plugin();
    for (size_t percent = 0; percent < 100; ++percent) {
        elf_probe probe = probe_bytes(plugin.at, plugin.length * percent / 100, true);
        ck_assert_ptr_nonnull(elf_probe_refusal(&probe));
    }
    elf_probe probe = probe_bytes(plugin.at, plugin.length - 1, true);
    ck_assert_ptr_nonnull(elf_probe_refusal(&probe));
    free(plugin.at);
}
END_TEST

/* Index of a program header of that type. */
static size_t find_segment(const unsigned char *bytes, Elf64_Word type)
{
    Elf64_Ehdr header;
    memcpy(&header, bytes, sizeof header);
    for (size_t i = 0; i < header.e_phnum; ++i) {
        Elf64_Phdr segment;
        size_t at = header.e_phoff + i * sizeof segment;
        memcpy(&segment, bytes + at, sizeof segment);
        if (segment.p_type == type) return at;
    }
    ck_abort_msg("no segment of type %u", type);
    return 0;
}

static elf_probe probe_with_field(Elf64_Word type, size_t field, Elf64_Xword value)
{
    sandbox_bytes plugin = good_plugin();
    memcpy(plugin.at + find_segment(plugin.at, type) + field, &value, sizeof value);
    elf_probe probe = probe_bytes(plugin.at, plugin.length, false);
    free(plugin.at);
    return probe;
}

START_TEST(sizes_and_offsets_that_wrap_around_are_refused)
{
    const Elf64_Xword wild[] = {UINT64_MAX, UINT64_MAX - 7, (Elf64_Xword)1 << 63, 1u << 30};
    for (size_t i = 0; i < sizeof wild / sizeof *wild; ++i) {
        elf_probe probe = probe_with_field(PT_LOAD, offsetof(Elf64_Phdr, p_offset), wild[i]);
        assert_refused_by(&probe, PROBE_SEGMENTS, "program header");
        probe = probe_with_field(PT_LOAD, offsetof(Elf64_Phdr, p_filesz), wild[i]);
        assert_refused_by(&probe, PROBE_SEGMENTS, "program header");
        probe = probe_with_field(PT_NOTE, offsetof(Elf64_Phdr, p_filesz), wild[i]);
        ck_assert_ptr_nonnull(elf_probe_refusal(&probe));
        probe = probe_patched(offsetof(Elf64_Ehdr, e_phoff), &wild[i], 8);
        assert_refused_by(&probe, PROBE_HEADERS, "program headers");
        probe = probe_patched(offsetof(Elf64_Ehdr, e_shoff), &wild[i], 8);
        assert_refused_by(&probe, PROBE_HEADERS, "section headers");
    }
    elf_probe probe = probe_with_field(PT_LOAD, offsetof(Elf64_Phdr, p_memsz), 0);
    assert_refused_by(&probe, PROBE_SEGMENTS, "program header");
}
END_TEST

/* The second part to be loaded, or a header beside them, moved to `address`. */
static elf_probe probe_moved(Elf64_Word type, Elf64_Addr address)
{
    sandbox_bytes plugin = good_plugin();
    size_t at = find_segment(plugin.at, type);
    if (type == PT_LOAD) at += sizeof(Elf64_Phdr);
    memcpy(plugin.at + at + offsetof(Elf64_Phdr, p_vaddr), &address, sizeof address);
    elf_probe probe = probe_bytes(plugin.at, plugin.length, false);
    free(plugin.at);
    return probe;
}

START_TEST(parts_that_overlap_in_memory_are_refused)
{
    elf_probe probe = probe_moved(PT_LOAD, 0);
    assert_refused_by(&probe, PROBE_SEGMENTS, "overlaps the loadable part before it");
    probe = probe_moved(PT_LOAD, 0x10000000);
    assert_refused_by(&probe, PROBE_SEGMENTS, "or lies below it");
    probe = probe_moved(PT_LOAD, 0x1001);
    assert_refused_by(&probe, PROBE_SEGMENTS, "aligned");
    probe = probe_with_field(PT_LOAD, offsetof(Elf64_Phdr, p_memsz), 1 << 20);
    assert_refused_by(&probe, PROBE_SEGMENTS, "overlaps");
}
END_TEST

START_TEST(headers_that_point_out_of_the_object_are_refused)
{
    const Elf64_Word followed[] = {PT_DYNAMIC, PT_GNU_RELRO, PT_GNU_EH_FRAME};
    for (size_t k = 0; k < sizeof followed / sizeof *followed; ++k) {
        elf_probe probe = probe_moved(followed[k], 0x7f0000000000);
        assert_refused_by(&probe, PROBE_SEGMENTS, "lies outside of what is loaded");
        probe = probe_with_field(followed[k], offsetof(Elf64_Phdr, p_memsz), 1 << 20);
        assert_refused_by(&probe, PROBE_SEGMENTS, "lies outside of what is loaded");
    }
}
END_TEST

START_TEST(a_file_without_our_note_is_no_plugin)
{
    elf_probe probe;
    ck_assert(!elf_probe_file(sandbox_plugin("no_note").at, true, &probe));
    assert_refused_by(&probe, PROBE_NOTE, "no Impinge note");
    ck_assert_int_eq(probe.check[PROBE_ABI].verdict, PROBE_NOT_REACHED);
}
END_TEST

/* Position of our note's owner in the file. */
static size_t find_owner(sandbox_bytes plugin)
{
    for (size_t at = 0; at + 8 <= plugin.length; ++at)
        if (memcmp(plugin.at + at, "Impinge", 8) == 0 && at >= 12 && plugin.at[at - 12] == 8)
            return at;
    ck_abort_msg("no note");
    return 0;
}

START_TEST(a_note_that_lies_about_its_sizes_is_refused)
{
    sandbox_bytes plugin = good_plugin();
    size_t note = find_owner(plugin) - 12;
    const uint32_t wild[] = {0, 7, 4096, 0x7FFFFFFF, 0xFFFFFFFF};
    for (size_t i = 0; i < sizeof wild / sizeof *wild; ++i) {
        elf_probe probe = probe_patched(note, &wild[i], 4); /* length of the owner */
        assert_refused_by(&probe, PROBE_NOTE, "");
        probe = probe_patched(note + 4, &wild[i], 4); /* length of the descriptor */
        assert_refused_by(&probe, PROBE_NOTE, "");
    }
    free(plugin.at);
}
END_TEST

START_TEST(names_in_the_note_must_be_lines_of_text)
{
    sandbox_bytes plugin = good_plugin();
    size_t name = find_owner(plugin) + 16;
    ck_assert_str_eq((const char *)plugin.at + name, "kit");
    elf_probe probe = probe_patched(name, "\0it", 3);
    assert_refused_by(&probe, PROBE_NOTE, "no legal name");
    probe = probe_patched(name, "\x1B[2", 3);
    assert_refused_by(&probe, PROBE_NOTE, "no legal name");
    probe = probe_patched(name, "\xFF\xFE", 2);
    assert_refused_by(&probe, PROBE_NOTE, "no legal name");
    probe = probe_patched(name + 4, "\n", 1);
    assert_refused_by(&probe, PROBE_NOTE, "no legal version");
    free(plugin.at);
}
END_TEST

START_TEST(another_abi_is_refused_by_field_values_and_cure)
{
    elf_probe probe;
    ck_assert(!elf_probe_file(sandbox_plugin("wrong_abi_major").at, true, &probe));
    assert_refused_by(&probe, PROBE_ABI, "abi_major is 9, the host's is 1; rebuild");
    ck_assert(!elf_probe_file(sandbox_plugin("newer_minor").at, true, &probe));
    assert_refused_by(&probe, PROBE_ABI, "abi_minor is 77, the host's is 0");
}
END_TEST

START_TEST(all_checks_are_run_on_request_and_one_refusal_ends_them_otherwise)
{
    sandbox_bytes plugin = good_plugin();
    memcpy(plugin.at + offsetof(Elf64_Ehdr, e_machine), &(Elf64_Half){EM_S390}, 2);
    elf_probe all = probe_bytes(plugin.at, plugin.length, true);
    elf_probe first = probe_bytes(plugin.at, plugin.length, false);
    ck_assert_int_eq(all.check[PROBE_ABI].verdict, PROBE_PASSED);
    ck_assert_int_eq(first.check[PROBE_ABI].verdict, PROBE_NOT_REACHED);
    assert_refused_by(&all, PROBE_MACHINE, "s390");
    assert_refused_by(&first, PROBE_MACHINE, "s390");
    free(plugin.at);
}
END_TEST

START_TEST(random_damage_never_harms_the_reader)
{
    uint64_t state = suite_seed();
    sandbox_bytes plugin = good_plugin(), damaged = good_plugin();
    for (int k = 0; k < suite_times(2000); ++k) {
        memcpy(damaged.at, plugin.at, plugin.length);
        for (uint64_t n = 1 + random_bits(&state) % 8; n > 0; --n) {
            /* mostly where headers and notes are */
            size_t reach = random_bits(&state) % 4 ? 1024 : plugin.length;
            damaged.at[random_bits(&state) % reach] = (unsigned char)random_bits(&state);
        }
        probe_bytes(damaged.at, plugin.length - random_bits(&state) % 3, true);
    }
    free(damaged.at);
    free(plugin.at);
}
END_TEST

SUITE_MAIN("elf_probe", a_good_plugin_passes_every_check_and_tells_its_note,
           a_missing_file_a_directory_and_a_pipe_are_refused_at_once,
           text_and_nothing_are_no_elf_files, foreign_machines_classes_and_orders_are_named,
           object_files_and_programs_are_not_shared_objects, a_plugin_cut_short_anywhere_is_refused,
           sizes_and_offsets_that_wrap_around_are_refused, parts_that_overlap_in_memory_are_refused,
           headers_that_point_out_of_the_object_are_refused, a_file_without_our_note_is_no_plugin,
           a_note_that_lies_about_its_sizes_is_refused, names_in_the_note_must_be_lines_of_text,
           another_abi_is_refused_by_field_values_and_cure,
           all_checks_are_run_on_request_and_one_refusal_ends_them_otherwise,
           random_damage_never_harms_the_reader)
