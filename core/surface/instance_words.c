/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/instance.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/hash.h"
#include "core/base/text.h"

/* What an instance is called, what its create remarked, and what it was made from. */

/* --- Labels ----------------------------------------------------------------------------------- */

void instance_label_add(char label[INSTANCE_LABEL_MAX], const char *text)
{
    static const char dots[] = " ...";
    const size_t used = strlen(label), more = strlen(text);
    if (used + more + sizeof dots <= INSTANCE_LABEL_MAX)
        memcpy(label + used, text, more + 1);
    else if (used < sizeof dots || strcmp(label + used - (sizeof dots - 1), dots) != 0)
        memcpy(label + used, dots, sizeof dots);
}

bool instance_set_label(shared_instance *p, const char label[INSTANCE_LABEL_MAX])
{
    p->label = strdup(label);
    return p->label != NULL;
}

void label_part_begin(label_part *part, const char *name)
{
    enum { MOST = 40 };
    const size_t length = strnlen(name, MOST);
    part->at[0] = ' ';
    memcpy(part->at + 1, name, length);
    memcpy(part->at + 1 + length, "=", 2);
    part->head = length + 2;
}

void label_part_end(label_part *part, bool fits, char label[INSTANCE_LABEL_MAX])
{
    if (!fits) memcpy(part->at + part->head, "...", 4);
    instance_label_add(label, part->at);
}

bool instance_name_arguments(shared_instance *p, size_t count, size_t numbers, double **number)
{
    label_arguments *to = &p->named;
    const size_t of_arguments = count * sizeof *to->at;
    const size_t wanted = of_arguments + numbers * sizeof **number;
    if (to->at == NULL || to->room < wanted) {
        free(to->at);
        *to = (label_arguments){.at = malloc(wanted + (wanted == 0)), .room = wanted};
        if (to->at == NULL) return false;
    }
    to->count = count;
    *number = (void *)((char *)to->at + of_arguments);
    return true;
}

/* Writes numbers as they would stand on a command line: 1,0,0. False: they are too long for that,
 * or there are none. */
static bool write_numbers(label_part *part, const double *number, size_t count)
{
    size_t used = part->head;
    for (size_t k = 0; k < count; ++k) {
        if (k > 0 && used + 1 < sizeof part->at) part->at[used++] = ',';
        if (!text_of_fifteen(part->at + used, sizeof part->at - used, number[k])) return false;
        used += strlen(part->at + used);
    }
    return count > 0;
}

static void add_arguments(const label_arguments *named, char label[INSTANCE_LABEL_MAX])
{
    const double *number = (const void *)(named->at + named->count);
    for (size_t k = 0; k < named->count; ++k) {
        label_part part;
        label_part_begin(&part, named->at[k].name);
        const bool fits = write_numbers(&part, number, named->at[k].count);
        label_part_end(&part, fits, label);
        number += named->at[k].count;
    }
}

void instance_label(const shared_instance *p, char label[INSTANCE_LABEL_MAX])
{
    while (p->inner != NULL) p = p->inner;
    label[0] = '\0';
    instance_label_add(label, p->label != NULL     ? p->label
                              : p->surface != NULL ? p->surface->name
                                                   : p->map->name);
    if (p->label == NULL && p->named.count > 0) add_arguments(&p->named, label);
}

/* --- Notes ------------------------------------------------------------------------------------ */

bool instance_set_note(shared_instance *p, uint64_t count, const char *text)
{
    p->note = strdup(text);
    if (p->note == NULL) return false;
    p->note_count = count;
    return true;
}

/* --- Descriptions ----------------------------------------------------------------------------- */

void instance_hash_description(instance_description *description)
{
    uint64_t hash = description->size;
    for (size_t k = 0; k < description->size; k += sizeof hash) {
        const size_t rest = description->size - k;
        uint64_t word = 0;
        memcpy(&word, description->bytes + k, rest < sizeof word ? rest : sizeof word);
        hash = hash_word(hash, word);
    }
    description->hash = hash;
}

/* Each isolated instance has a type of its own, with the name of the type it stands for. No two
 * types of a registry share the text of a name. */
bool instance_is_equal_map(const shared_instance *x, const shared_instance *y)
{
    const instance_description *of_x = x->description, *of_y = y->description;
    const bool same_type = x->map != NULL && y->map != NULL && x->map->name == y->map->name;
    return same_type && of_x != NULL && of_y != NULL && of_x->hash == of_y->hash &&
           of_x->size == of_y->size && memcmp(of_x->bytes, of_y->bytes, of_x->size) == 0;
}
