/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_tables_internal.h"

/* --- Hashes ----------------------------------------------------------------------------------- */

static bool refuse_hashes(elf_object *o)
{
    return elf_refuse(o, "its table of hashes leads out of itself");
}

/* DT_HASH: nbucket, nchain, then that many of both, which are symbols. */
static bool count_by_hash(elf_object *o, uint64_t at)
{
    Elf64_Word head[2], symbol;
    if (!elf_dynamic_load(&o->d, at, head, sizeof head)) return refuse_hashes(o);
    o->symbol_count = head[1];
    for (uint64_t k = 0; k < (uint64_t)head[0] + head[1]; ++k)
        if (!elf_dynamic_load(&o->d, at + 8 + 4 * k, &symbol, sizeof symbol) || symbol >= head[1])
            return refuse_hashes(o);
    return true;
}

/* DT_GNU_HASH: nbuckets, the first symbol that is hashed, words of a filter, its shift; the filter;
 * the first symbol of each bucket, or 0; for each hashed symbol a word, odd for the last one of a
 * bucket. So where the bucket that begins last ends, all end, and so do the symbols. Where none is
 * hashed, only relocations refer to symbols. */
static bool count_by_gnu_hash(elf_object *o, uint64_t at)
{
    Elf64_Word head[4], symbol, last = 0, word = 0;
    if (!elf_dynamic_load(&o->d, at, head, sizeof head)) return refuse_hashes(o);
    const Elf64_Word words = head[2];
    if (head[0] == 0 || words == 0 || (words & (words - 1)) != 0) return refuse_hashes(o);
    const uint64_t filter = at + sizeof head, buckets = filter + (uint64_t)words * 8,
                   chain = buckets + (uint64_t)head[0] * 4;
    if (!elf_dynamic_has(&o->d, filter, chain - filter)) return refuse_hashes(o);
    for (uint64_t k = 0; k < head[0]; ++k) {
        if (!elf_dynamic_load(&o->d, buckets + 4 * k, &symbol, sizeof symbol)) return false;
        if (symbol != 0 && symbol < head[1]) return refuse_hashes(o);
        if (symbol > last) last = symbol;
    }
    o->symbol_count = last == 0 ? elf_relocations_symbols(o) : last;
    while (last != 0 && (word & 1) == 0) {
        const uint64_t next = chain + 4 * (o->symbol_count++ - head[1]);
        if (!elf_dynamic_load(&o->d, next, &word, sizeof word)) return refuse_hashes(o);
    }
    return true;
}

static bool count_symbols(elf_object *o)
{
    uint64_t at;
    if (elf_dynamic_find(&o->d, DT_HASH, &at) && !count_by_hash(o, at)) return false;
    if (elf_dynamic_find(&o->d, DT_GNU_HASH, &at) && !count_by_gnu_hash(o, at)) return false;
    return o->symbol_count > 0 || elf_refuse(o, "it has no table of hashes");
}

/* --- Versions --------------------------------------------------------------------------------- */

enum { STEPS_MAX = 4096 }; /* of a chain; usual are 1 to 20 */

static void note_version(elf_object *o, unsigned index)
{
    index &= 0x7fff;
    if (index > o->last_version) o->last_version = index;
}

static bool refuse_versions(elf_object *o)
{
    return elf_refuse(o, "its versions lead out of their table");
}

static bool check_needed_names(elf_object *o, uint64_t at)
{
    Elf64_Vernaux one;
    for (unsigned step = 0; step < STEPS_MAX; ++step, at += one.vna_next) {
        if (!elf_dynamic_load(&o->d, at, &one, sizeof one)) break;
        if (!elf_check_name(o, one.vna_name, "a version")) return false;
        note_version(o, one.vna_other);
        if (one.vna_next == 0) return true;
    }
    return refuse_versions(o);
}

static bool check_needed(elf_object *o, uint64_t at)
{
    Elf64_Verneed one;
    for (unsigned step = 0; step < STEPS_MAX; ++step, at += one.vn_next) {
        if (!elf_dynamic_load(&o->d, at, &one, sizeof one)) break;
        if (!elf_check_name(o, one.vn_file, "a needed file")) return false;
        if (!check_needed_names(o, at + one.vn_aux)) return false;
        if (one.vn_next == 0) return true;
    }
    return refuse_versions(o);
}

static bool check_defined(elf_object *o, uint64_t at)
{
    Elf64_Verdef one;
    for (unsigned step = 0; step < STEPS_MAX; ++step, at += one.vd_next) {
        Elf64_Verdaux name;
        if (!elf_dynamic_load(&o->d, at, &one, sizeof one)) break;
        if (!elf_dynamic_load(&o->d, at + one.vd_aux, &name, sizeof name)) break;
        if (!elf_check_name(o, name.vda_name, "a version")) return false;
        note_version(o, one.vd_ndx);
        if (one.vd_next == 0) return true;
    }
    return refuse_versions(o);
}

static bool check_versions(elf_object *o)
{
    uint64_t at;
    if (elf_dynamic_find(&o->d, DT_VERNEED, &at) && !check_needed(o, at)) return false;
    if (elf_dynamic_find(&o->d, DT_VERDEF, &at) && !check_defined(o, at)) return false;
    if (!elf_dynamic_find(&o->d, DT_VERSYM, &at)) return true;
    for (uint64_t k = 0; k < o->symbol_count; ++k) {
        Elf64_Half version;
        if (!elf_dynamic_load(&o->d, at + 2 * k, &version, sizeof version))
            return elf_refuse(o, "the versions of its symbols lie outside of what is loaded");
        if ((version & 0x7fffu) > 1 && (version & 0x7fffu) > o->last_version)
            return elf_refuse(o, "symbol %llu has version %u, the last that is declared is %u",
                              (unsigned long long)k, version & 0x7fffu, o->last_version);
    }
    return true;
}

/* --- Symbols ---------------------------------------------------------------------------------- */

bool elf_symbol_load(elf_object *o, uint64_t k, Elf64_Sym *symbol)
{
    return elf_dynamic_load(&o->d, o->symbols + k * sizeof *symbol, symbol, sizeof *symbol);
}

bool elf_symbol_is_placed(const Elf64_Sym *s)
{
    return s->st_shndx != SHN_UNDEF && s->st_shndx != SHN_ABS &&
           ELF64_ST_TYPE(s->st_info) != STT_TLS;
}

bool elf_symbol_is_of_thread(const Elf64_Sym *s)
{
    return s->st_shndx != SHN_UNDEF && ELF64_ST_TYPE(s->st_info) == STT_TLS;
}

static bool is_inside(const elf_object *o, const Elf64_Sym *s)
{
    const uint64_t thread = o->d.loads->thread_bytes;
    if (elf_symbol_is_of_thread(s))
        return s->st_value <= thread && s->st_size <= thread - s->st_value;
    if (!elf_symbol_is_placed(s)) return true;
    return elf_loads_span(o->d.loads, s->st_value, s->st_size) &&
           (ELF64_ST_TYPE(s->st_info) != STT_GNU_IFUNC || elf_is_code(o, s->st_value));
}

static bool check_symbols(elf_object *o)
{
    if (!elf_dynamic_find(&o->d, DT_SYMTAB, &o->symbols)) return elf_refuse(o, "it has no symbols");
    for (uint64_t k = 0; k < o->symbol_count; ++k) {
        Elf64_Sym s;
        if (!elf_symbol_load(o, k, &s))
            return elf_refuse(o, "its %llu symbols lie outside of what is loaded",
                              (unsigned long long)o->symbol_count);
        if (!elf_check_name(o, s.st_name, "a symbol")) return false;
        if (!is_inside(o, &s))
            return elf_refuse(o, "symbol %llu (%llu bytes at %#llx) lies outside of what is loaded",
                              (unsigned long long)k, (unsigned long long)s.st_size,
                              (unsigned long long)s.st_value);
    }
    return true;
}

bool elf_symbols_check(elf_object *o)
{
    return count_symbols(o) && check_versions(o) && check_symbols(o);
}
