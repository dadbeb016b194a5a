/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/instance.h"

#include <stdlib.h>
#include <string.h>

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
    const size_t size = strlen(label) + 1;
    if (p->label_room < size) { /* one that is used again may get any label */
        const size_t room = p->label != NULL ? INSTANCE_LABEL_MAX : size;
        free(p->label);
        p->label = malloc(room);
        p->label_room = p->label != NULL ? room : 0;
    }
    if (p->label == NULL) return false;
    memcpy(p->label, label, size);
    p->label_size = size;
    return true;
}

const char *instance_label(const shared_instance *p)
{
    if (p->label != NULL) return p->label;
    if (p->inner != NULL) return instance_label(p->inner);
    return p->surface != NULL ? p->surface->name : p->map->name;
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

/* Each isolated instance has a type of its own, with the name of the type it stands for. No two
 * types of a registry share the text of a name. */
bool instance_is_equal_map(const shared_instance *x, const shared_instance *y)
{
    const instance_description *of_x = x->description, *of_y = y->description;
    const bool same_type = x->map != NULL && y->map != NULL && x->map->name == y->map->name;
    return same_type && of_x != NULL && of_y != NULL && of_x->size == of_y->size &&
           memcmp(of_x->bytes, of_y->bytes, of_x->size) == 0;
}
