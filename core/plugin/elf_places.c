/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/plugin/elf_tables_internal.h"

#include <stdlib.h>

/* Where relocations write
 * =======================
 * Lemma. Let every relocation write bytes of one part that may be written, none of them in the
 * dynamic table and none twice. Then the memory after all relocations does not depend on their
 * order, every word has the one value that was checked with its relocation, and the addresses and
 * sizes that the loader takes from the dynamic table afterwards are those that were read here. So a
 * constructor whose word is relocated to code of the object is called where it was checked.
 *
 * Proof. Two relocations write disjoint bytes, so that neither changes what the other one wrote.
 * The value of a relocation depends on its entry, on symbols, and for packed ones on the word that
 * it replaces, which no other one writes. */

/* Each place has a byte of the file of its own, unless it is refused: entries take 24 bytes, packed
 * ones stand for words that the file has. So the number of places is less than its size. */
static bool make_room(elf_object *o)
{
    elf_places *p = &o->places;
    if (p->count < p->room) return true;
    const size_t room = p->room == 0 ? 256 : 2 * p->room;
    if (p->count >= o->d.file->size)
        return elf_refuse(o, "its %zu relocations are too many", p->count);
    elf_place *grown = realloc(p->place, room * sizeof *grown);
    if (grown == NULL) {
        o->d.file->lacks_memory = true;
        return elf_refuse(o, "there is no memory to check its relocations");
    }
    p->place = grown, p->room = room;
    return true;
}

static bool overlap(uint64_t a, uint64_t a_length, uint64_t b, uint64_t b_length)
{
    if (a_length == 0 || b_length == 0) return false;
    return a < b ? b - a < a_length : a - b < b_length;
}

bool elf_places_add(elf_object *o, uint64_t at, uint64_t length)
{
    const uint64_t dynamic = o->d.loads->dynamic.p_vaddr,
                   dynamic_bytes = (o->d.count + 1) * sizeof(Elf64_Dyn);
    /* A place whose length is not known has 1 byte, and up to a word. */
    if (!elf_is_in_part(o, at, length > 1 ? length : 8, o->written))
        return elf_refuse(o, "a relocation writes to %#llx, which is not the object's to write",
                          (unsigned long long)at);
    if (overlap(at, length, dynamic, dynamic_bytes))
        return elf_refuse(o, "a relocation writes to %#llx, in the dynamic table",
                          (unsigned long long)at);
    if (!make_room(o)) return false;
    o->places.place[o->places.count++] = (elf_place){at, length};
    return true;
}

bool elf_places_are_called(const elf_object *o, uint64_t at, uint64_t length)
{
    for (int k = 0; k < 2; ++k)
        if (overlap(at, length, o->called[k][0], o->called[k][1])) return true;
    return false;
}

static int by_address(const void *left, const void *right)
{
    const elf_place *a = left, *b = right;
    return a->at < b->at ? -1 : a->at > b->at;
}

static bool check_apart(elf_object *o)
{
    const elf_place *p = o->places.place;
    for (size_t k = 1; k < o->places.count; ++k)
        if (overlap(p[k - 1].at, p[k - 1].length, p[k].at, p[k].length))
            return elf_refuse(o, "two relocations write to %#llx", (unsigned long long)p[k].at);
    return true;
}

/* Each word of an array is written, as a whole. */
static bool check_array(elf_object *o, const uint64_t array[2])
{
    uint64_t written = 0;
    for (size_t k = 0; k < o->places.count; ++k) {
        const elf_place p = o->places.place[k];
        if (!overlap(p.at, p.length, array[0], array[1])) continue;
        if (p.length != 8 || p.at < array[0] || (p.at - array[0]) % 8 != 0)
            return elf_refuse(o, "a relocation at %#llx writes a part of what is called",
                              (unsigned long long)p.at);
        written += 8;
    }
    return written == array[1] ||
           elf_refuse(o, "%llu bytes of its constructors or destructors are relocated, of %llu",
                      (unsigned long long)written, (unsigned long long)array[1]);
}

bool elf_places_check(elf_object *o, bool is_exact)
{
    if (o->places.count > 0)
        qsort(o->places.place, o->places.count, sizeof *o->places.place, by_address);
    return check_apart(o) &&
           (!is_exact || (check_array(o, o->called[0]) && check_array(o, o->called[1])));
}
