/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_file.h"

#include <assert.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

#define NOTES_MAX (1u << 20) /* bytes of a note segment we search; real ones have a few hundred */
#define OWNER_MAX 32u        /* bytes of an owner's name, with the NUL */

bool elf_file_has(const elf_file *file, uint64_t offset, uint64_t length)
{
    return offset <= file->size && length <= file->size - offset;
}

static bool read_bytes(const elf_file *file, uint64_t offset, void *buffer, size_t length)
{
    char *to = buffer;
    while (length > 0) {
        ssize_t n = pread(file->fd, to, length, (off_t)offset);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        to += n;
        offset += (uint64_t)n;
        length -= (size_t)n;
    }
    return true;
}

static bool is_held(const elf_block *block, uint64_t offset, size_t length)
{
    return offset >= block->start && offset - block->start <= block->length &&
           length <= block->length - (offset - block->start);
}

static void read_block(const elf_file *file, uint64_t offset, elf_block *block)
{
    const uint64_t start = offset / ELF_BLOCK * ELF_BLOCK, rest = file->size - start;
    block->start = start;
    block->length = rest < ELF_BLOCK ? rest : ELF_BLOCK;
    if (!read_bytes(file, start, block->bytes, block->length)) block->length = 0;
}

bool elf_file_read(elf_file *file, uint64_t offset, void *buffer, size_t length)
{
    if (!elf_file_has(file, offset, length)) return false;
    if (!is_held(&file->blocks[file->recent], offset, length)) {
        file->recent ^= 1;
        elf_block *other = &file->blocks[file->recent];
        if (!is_held(other, offset, length)) read_block(file, offset, other);
    }
    const elf_block *block = &file->blocks[file->recent];
    if (!is_held(block, offset, length)) return read_bytes(file, offset, buffer, length);
    memcpy(buffer, block->bytes + (offset - block->start), length);
    return true;
}

bool elf_file_segment(elf_file *file, unsigned index, Elf64_Phdr *segment)
{
    assert(index < file->header.e_phnum);
    uint64_t table = file->header.e_phoff, at = (uint64_t)index * sizeof *segment;
    return at <= UINT64_MAX - table && elf_file_read(file, table + at, segment, sizeof *segment);
}

static uint64_t rounded_up(uint64_t n, uint64_t step) { return (n + step - 1) / step * step; }

static bool has_owner(elf_file *file, uint64_t offset, uint64_t length, const char *owner)
{
    char found[OWNER_MAX];
    return length == strlen(owner) + 1 && elf_file_read(file, offset, found, length) &&
           memcmp(found, owner, length) == 0;
}

/* Walks over the notes of one segment. No sum wraps around: sizes in a note have 32 bits, the
 * segment has at most NOTES_MAX bytes, and lies inside the file. */
static elf_span find_in_segment(elf_file *file, const Elf64_Phdr *segment, const char *owner,
                                uint32_t type)
{
    elf_span none = {0, 0};
    uint64_t start = segment->p_offset, size = segment->p_filesz;
    if (size > NOTES_MAX || !elf_file_has(file, start, size)) return none;
    uint64_t step = segment->p_align == 8 ? 8 : 4, at = 0;
    while (at <= size && size - at >= sizeof(Elf64_Nhdr)) {
        Elf64_Nhdr note;
        if (!elf_file_read(file, start + at, &note, sizeof note)) return none;
        uint64_t name = at + sizeof note;
        uint64_t descriptor = rounded_up(name + note.n_namesz, step);
        uint64_t end = descriptor + note.n_descsz;
        if (end > size) return none;
        if (note.n_type == type && has_owner(file, start + name, note.n_namesz, owner))
            return (elf_span){start + descriptor, note.n_descsz};
        at = rounded_up(end, step);
    }
    return none;
}

elf_span elf_file_find_note(elf_file *file, const char *owner, uint32_t type)
{
    assert(strlen(owner) < OWNER_MAX);
    elf_span found = {0, 0};
    for (unsigned i = 0; i < file->header.e_phnum && found.length == 0; ++i) {
        Elf64_Phdr segment;
        if (elf_file_segment(file, i, &segment) && segment.p_type == PT_NOTE)
            found = find_in_segment(file, &segment, owner, type);
    }
    return found;
}

const char *elf_class_name(unsigned char class)
{
    return class == ELFCLASS32 ? "32-bit" : class == ELFCLASS64 ? "64-bit" : "of unknown word size";
}

const char *elf_order_name(unsigned char order)
{
    return order == ELFDATA2LSB   ? "little-endian"
           : order == ELFDATA2MSB ? "big-endian"
                                  : "of unknown byte order";
}

const char *elf_machine_name(Elf64_Half machine)
{
    switch (machine) {
    case EM_386:
        return "i386";
    case EM_X86_64:
        return "x86-64";
    case EM_ARM:
        return "arm";
    case EM_AARCH64:
        return "aarch64";
    case EM_PPC64:
        return "ppc64";
    case EM_S390:
        return "s390";
    case EM_RISCV:
        return "riscv";
    case EM_LOONGARCH:
        return "loongarch";
    default:
        return "another processor";
    }
}
