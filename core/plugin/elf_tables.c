/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_tables.h"

#include "core/plugin/elf_tables_internal.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool elf_refuse(elf_object *o, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(o->text, o->size, format, arguments);
    va_end(arguments);
    return false;
}

bool elf_is_in_part(const elf_object *o, uint64_t address, uint64_t length, Elf64_Word flag)
{
    const Elf64_Phdr *part = elf_loads_part(o->d.loads, address, length);
    return part != NULL && (part->p_flags & flag) == flag;
}

bool elf_is_code(const elf_object *o, uint64_t address)
{
    return elf_is_in_part(o, address, 1, PF_X);
}

/* --- Strings ---------------------------------------------------------------------------------- */

bool elf_check_name(elf_object *o, uint64_t name, const char *whose)
{
    return name < o->string_bytes ||
           elf_refuse(o, "the name of %s begins at %llu, of %llu bytes of strings", whose,
                      (unsigned long long)name, (unsigned long long)o->string_bytes);
}

static bool is_name(Elf64_Sxword tag)
{
    return tag == DT_NEEDED || tag == DT_SONAME || tag == DT_RPATH || tag == DT_RUNPATH ||
           tag == DT_AUXILIARY || tag == DT_FILTER;
}

static bool check_strings(elf_object *o)
{
    uint64_t at;
    char last = 1;
    elf_dynamic_find(&o->d, DT_STRSZ, &o->string_bytes);
    if (!elf_dynamic_find(&o->d, DT_STRTAB, &at) || !elf_dynamic_has(&o->d, at, o->string_bytes) ||
        o->string_bytes == 0)
        return elf_refuse(o, "its strings lie outside of what is loaded");
    if (!elf_dynamic_load(&o->d, at + o->string_bytes - 1, &last, 1) || last != '\0')
        return elf_refuse(o, "its strings do not end");
    for (unsigned k = 0; k < o->d.count; ++k) {
        const Elf64_Dyn *entry = &o->d.entry[k];
        if (is_name(entry->d_tag) && !elf_check_name(o, entry->d_un.d_val, "a dynamic entry"))
            return false;
    }
    return true;
}

bool elf_tables_check(elf_file *file, const elf_loads *loads, char *text, size_t size)
{
    elf_object o = {.text = text, .size = size};
    if (!elf_dynamic_open(&o.d, file, loads))
        return elf_refuse(&o, "its dynamic table does not end");
    const bool good = check_strings(&o) && elf_symbols_check(&o) && elf_relocations_check(&o);
    free(o.places.place);
    if (!good) return false;
    snprintf(text, size, "%llu symbols, all inside the object", (unsigned long long)o.symbol_count);
    return true;
}

elf_runtime elf_tables_runtime(elf_file *file, const elf_loads *loads)
{
    elf_dynamic d;
    uint64_t strings, bytes;
    elf_runtime found = {""};
    if (!elf_dynamic_open(&d, file, loads) || !elf_dynamic_find(&d, DT_STRTAB, &strings) ||
        !elf_dynamic_find(&d, DT_STRSZ, &bytes))
        return found;
    for (unsigned k = 0; k < d.count && found.name[0] == '\0'; ++k) {
        const uint64_t name = d.entry[k].d_un.d_val;
        if (d.entry[k].d_tag != DT_NEEDED || name >= bytes) continue;
        const uint64_t room = sizeof found.name - 1, left = bytes - name;
        const size_t length = (size_t)(left < room ? left : room);
        const bool is_read = elf_dynamic_load(&d, strings + name, found.name, length);
        found.name[is_read ? length : 0] = '\0';
        if (strncmp(found.name, "libasan.", 8) != 0 && strncmp(found.name, "libtsan.", 8) != 0)
            found.name[0] = '\0';
    }
    return found;
}
