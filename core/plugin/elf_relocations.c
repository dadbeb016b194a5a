/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_tables_internal.h"

/* Numbers of kinds of relocations, by machine; on others kinds are not told apart. */
typedef struct machine_kinds {
    Elf64_Half machine;
    Elf64_Word relative;   /* to where the object is */
    Elf64_Word resolved;   /* what the function at the addend answers */
    Elf64_Word copy;       /* a symbol's bytes; of programs only */
    Elf64_Word descriptor; /* of thread-local storage: two words */
    Elf64_Word thread[2];  /* offset in thread-local storage, from either end */
    Elf64_Word half[3];    /* write 4 bytes */
} machine_kinds;

static const machine_kinds kinds_of_machines[] = {
    {EM_X86_64,
     R_X86_64_RELATIVE,
     R_X86_64_IRELATIVE,
     R_X86_64_COPY,
     R_X86_64_TLSDESC,
     {R_X86_64_DTPOFF64, R_X86_64_TPOFF64},
     {R_X86_64_32, R_X86_64_PC32, R_X86_64_SIZE32}},
    {EM_AARCH64,
     R_AARCH64_RELATIVE,
     R_AARCH64_IRELATIVE,
     R_AARCH64_COPY,
     R_AARCH64_TLSDESC,
     {R_AARCH64_TLS_DTPREL, R_AARCH64_TLS_TPREL},
     {R_AARCH64_ABS32, R_AARCH64_PREL32, R_AARCH64_PREL32}},
};

static const machine_kinds *kinds_of(const elf_object *o)
{
    const size_t count = sizeof kinds_of_machines / sizeof *kinds_of_machines;
    for (size_t k = 0; k < count; ++k)
        if (kinds_of_machines[k].machine == o->d.file->header.e_machine)
            return &kinds_of_machines[k];
    return NULL;
}

/* A table of that many bytes; false: there is none, or it is empty. */
static bool find_table(const elf_object *o, Elf64_Sxword tag, Elf64_Sxword size_tag,
                       uint64_t *address, uint64_t *length)
{
    const bool found = elf_dynamic_find(&o->d, tag, address);
    elf_dynamic_find(&o->d, size_tag, length);
    return found && *length > 0;
}

/* --- What is called when the object is loaded and unloaded ------------------------------------ */

static bool check_function(elf_object *o, Elf64_Sxword tag)
{
    uint64_t at;
    return !elf_dynamic_find(&o->d, tag, &at) || elf_is_code(o, at) ||
           elf_refuse(o, "its first or last function is no code");
}

/* Loaders ignore what is no whole word. */
static bool check_array(elf_object *o, Elf64_Sxword tag, Elf64_Sxword size_tag, uint64_t array[2])
{
    array[0] = array[1] = 0;
    if (!find_table(o, tag, size_tag, &array[0], &array[1])) array[0] = array[1] = 0;
    array[1] -= array[1] % 8;
    return array[1] == 0 || elf_is_in_part(o, array[0], array[1], PF_R) ||
           elf_refuse(o, "its constructors or destructors lie outside of what is loaded");
}

static bool check_calls(elf_object *o)
{
    return check_function(o, DT_INIT) && check_function(o, DT_FINI) &&
           check_array(o, DT_INIT_ARRAY, DT_INIT_ARRAYSZ, o->called[0]) &&
           check_array(o, DT_FINI_ARRAY, DT_FINI_ARRAYSZ, o->called[1]);
}

/* --- Relocations ------------------------------------------------------------------------------ */

/* Code too, where the object says so. */
static Elf64_Word written_flag(const elf_object *o)
{
    uint64_t flags;
    const bool code = elf_dynamic_find(&o->d, DT_TEXTREL, &flags) ||
                      (elf_dynamic_find(&o->d, DT_FLAGS, &flags) && (flags & DF_TEXTREL) != 0);
    return code ? PF_R : PF_W;
}

static bool check_target(elf_object *o, uint64_t place, uint64_t target)
{
    if (elf_places_are_called(o, place, 8) ? elf_is_code(o, target)
                                           : elf_loads_span(o->d.loads, target, 0))
        return true;
    return elf_refuse(o, "a relocation at %#llx refers to %#llx, outside of what is loaded",
                      (unsigned long long)place, (unsigned long long)target);
}

/* Where kinds are not told apart, only the first byte is known to be written. */
static uint64_t bytes_written(const machine_kinds *kinds, uint64_t kind)
{
    if (kinds == NULL) return 1;
    for (size_t k = 0; k < sizeof kinds->half / sizeof *kinds->half; ++k)
        if (kind == kinds->half[k]) return 4;
    return kind == kinds->descriptor ? 16 : 8;
}

/* What is called is an address of the object's own code: relative to it, or of its symbol `s`. */
static bool check_called(elf_object *o, const machine_kinds *kinds, const Elf64_Rela *r,
                         const Elf64_Sym *s)
{
    const uint64_t kind = ELF64_R_TYPE(r->r_info);
    if (!elf_places_are_called(o, r->r_offset, bytes_written(kinds, kind))) return true;
    return kind == kinds->relative || (kind != kinds->resolved && s != NULL) ||
           elf_refuse(o, "a relocation at %#llx makes it call what is not its own code",
                      (unsigned long long)r->r_offset);
}

/* An offset in the object's own thread-local storage; of another object's it is not known. */
static bool check_thread(elf_object *o, const machine_kinds *kinds, const Elf64_Rela *r)
{
    const uint64_t kind = ELF64_R_TYPE(r->r_info), symbol = ELF64_R_SYM(r->r_info);
    Elf64_Sym s = {.st_value = 0};
    if (kind != kinds->thread[0] && kind != kinds->thread[1] && kind != kinds->descriptor)
        return true;
    if (symbol != 0 && (!elf_symbol_load(o, symbol, &s) || !elf_symbol_is_of_thread(&s)))
        return true;
    return s.st_value + (uint64_t)r->r_addend <= o->d.loads->thread_bytes ||
           elf_refuse(o, "a relocation at %#llx refers to byte %llu of %llu of a thread",
                      (unsigned long long)r->r_offset,
                      (unsigned long long)(s.st_value + (uint64_t)r->r_addend),
                      (unsigned long long)o->d.loads->thread_bytes);
}

/* Checks the value that a relocation writes, on a machine whose relocation types are known. */
static bool check_value(elf_object *o, const machine_kinds *kinds, const Elf64_Rela *r)
{
    const uint64_t kind = ELF64_R_TYPE(r->r_info), symbol = ELF64_R_SYM(r->r_info),
                   target = (uint64_t)r->r_addend;
    Elf64_Sym s;
    const bool placed = symbol != 0 && elf_symbol_load(o, symbol, &s) && elf_symbol_is_placed(&s);
    if (kind == kinds->copy) return elf_refuse(o, "a relocation copies, as in a program");
    if (!check_called(o, kinds, r, placed ? &s : NULL) || !check_thread(o, kinds, r)) return false;
    if (kind == kinds->relative) return check_target(o, r->r_offset, target);
    if (kind == kinds->resolved)
        return elf_is_code(o, target) ||
               elf_refuse(o, "a resolver at %#llx is no code", (unsigned long long)target);
    return !placed || check_target(o, r->r_offset, s.st_value + target);
}

static bool check_relocation(elf_object *o, const machine_kinds *kinds, const Elf64_Rela *r)
{
    const uint64_t kind = ELF64_R_TYPE(r->r_info), symbol = ELF64_R_SYM(r->r_info);
    if (kind == 0) return true; /* none, on every machine */
    if (symbol >= o->symbol_count)
        return elf_refuse(o, "a relocation is of symbol %llu, there are %llu",
                          (unsigned long long)symbol, (unsigned long long)o->symbol_count);
    return elf_places_add(o, r->r_offset, bytes_written(kinds, kind)) &&
           (kinds == NULL || check_value(o, kinds, r));
}

/* Loaders take that many of the first entries for relative ones, whatever their kind. */
static uint64_t count_relative(const elf_object *o, Elf64_Sxword tag)
{
    uint64_t count = 0;
    if (tag == DT_RELA) elf_dynamic_find(&o->d, DT_RELACOUNT, &count);
    return count;
}

/* Whether that table is the end of another one, as old linkers have it; loaders then skip it. */
static bool is_within(const elf_object *o, uint64_t at, uint64_t length)
{
    uint64_t other, size;
    return find_table(o, DT_RELA, DT_RELASZ, &other, &size) && at >= other && at - other < size &&
           length == size - (at - other);
}

static bool check_rela(elf_object *o, Elf64_Sxword tag, Elf64_Sxword size_tag)
{
    const machine_kinds *kinds = kinds_of(o);
    const uint64_t relative = count_relative(o, tag);
    uint64_t at, length;
    if (!find_table(o, tag, size_tag, &at, &length)) return true;
    if (tag == DT_JMPREL && is_within(o, at, length)) return true;
    for (uint64_t k = 0; k < length / sizeof(Elf64_Rela); ++k) {
        Elf64_Rela r;
        if (!elf_dynamic_load(&o->d, at + k * sizeof r, &r, sizeof r))
            return elf_refuse(o, "its relocations lie outside of what is loaded");
        if (kinds != NULL && k < relative && ELF64_R_TYPE(r.r_info) != kinds->relative)
            return elf_refuse(o, "relocation %llu is not relative, the first %llu must be",
                              (unsigned long long)k, (unsigned long long)relative);
        if (!check_relocation(o, kinds, &r)) return false;
    }
    return true;
}

uint64_t elf_relocations_symbols(elf_object *o)
{
    static const Elf64_Sxword tables[2][2] = {{DT_RELA, DT_RELASZ}, {DT_JMPREL, DT_PLTRELSZ}};
    uint64_t at, length, last = 0;
    Elf64_Rela r;
    for (int t = 0; t < 2; ++t)
        if (find_table(o, tables[t][0], tables[t][1], &at, &length))
            for (uint64_t k = 0; elf_dynamic_load(&o->d, at + k, &r, sizeof r) && k < length;
                 k += sizeof r)
                if (ELF64_R_SYM(r.r_info) > last) last = ELF64_R_SYM(r.r_info);
    return last + 1;
}

/* A word that holds what it refers to, relative to where the object is. */
static bool check_word(elf_object *o, uint64_t place)
{
    uint64_t target;
    if (!elf_places_add(o, place, sizeof target)) return false;
    return elf_dynamic_load(&o->d, place, &target, sizeof target)
               ? check_target(o, place, target)
               : elf_refuse(o, "a relative relocation at %#llx is of no word of the file",
                            (unsigned long long)place);
}

/* DT_RELR: an even entry is the address of a word; bit k of an odd one stands for the k-th word
 * after the last one that an entry reached. */
static bool check_relr(elf_object *o)
{
    uint64_t at, length, entry, next = 0;
    if (!find_table(o, DT_RELR, DT_RELRSZ, &at, &length)) return true;
    for (uint64_t k = 0; k + sizeof entry <= length; k += sizeof entry) {
        if (!elf_dynamic_load(&o->d, at + k, &entry, sizeof entry))
            return elf_refuse(o, "its relative relocations lie outside of what is loaded");
        if ((entry & 1) == 0 && !check_word(o, entry)) return false;
        if ((entry & 1) == 0) next = entry + 8;
        for (unsigned bit = 1; (entry & 1) != 0 && bit < 64; ++bit)
            if ((entry >> bit & 1) != 0 && !check_word(o, next + 8 * (bit - 1))) return false;
        if ((entry & 1) != 0) next += 63 * 8;
    }
    return true;
}

/* Loaders assert these. */
static bool check_sizes(elf_object *o)
{
    static const uint64_t expected[][2] = {{DT_SYMENT, sizeof(Elf64_Sym)},
                                           {DT_RELAENT, sizeof(Elf64_Rela)},
                                           {DT_RELRENT, 8},
                                           {DT_PLTREL, DT_RELA}};
    for (size_t k = 0; k < sizeof expected / sizeof *expected; ++k) {
        uint64_t size;
        if (elf_dynamic_find(&o->d, (Elf64_Sxword)expected[k][0], &size) && size != expected[k][1])
            return elf_refuse(o, "its dynamic entry %llu is %llu, expected %llu",
                              (unsigned long long)expected[k][0], (unsigned long long)size,
                              (unsigned long long)expected[k][1]);
    }
    return true;
}

bool elf_relocations_check(elf_object *o)
{
    o->written = written_flag(o);
    return check_sizes(o) && check_calls(o) && check_rela(o, DT_RELA, DT_RELASZ) &&
           check_rela(o, DT_JMPREL, DT_PLTRELSZ) && check_relr(o) &&
           elf_places_check(o, kinds_of(o) != NULL);
}
