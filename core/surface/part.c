/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/part.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "core/surface/surface_parts.h"

/* --- Creation and destruction ------------------------------------------------------------ */

/* What destroy does to the floating-point mode is undone. */
static void destroy(const char *type, void (*destroy_it)(void *), void *self)
{
    const fp_mode mode = surface_call_begin(type, "destroy");
    destroy_it(self);
    surface_call_end(mode, IMP_OK);
}

/* Domains are asked for once; one that is not finite in u and v, inverted or NaN is a breach. */
static void take_domain(shared_part *p)
{
    const fp_mode mode = surface_call_begin(p->surface->name, "domain");
    p->surface->domain(p->self, p->lo, p->hi);
    p->breach = surface_call_end(mode, IMP_OK);
    bool good = p->lo[0] > -INFINITY && p->lo[1] > -INFINITY;
    good = good && p->hi[0] < INFINITY && p->hi[1] < INFINITY;
    for (int j = 0; j < 3; ++j) good = good && p->lo[j] <= p->hi[j];
    if (p->breach == IMP_OK && !good) p->breach = SURFACE_BAD_DOMAIN;
}

static void take_times(shared_part *p)
{
    p->lo[2] = -INFINITY, p->hi[2] = INFINITY;
    const fp_mode mode = surface_call_begin(p->map->name, "time_domain");
    p->map->time_domain(p->self, &p->lo[2], &p->hi[2]);
    p->breach = surface_call_end(mode, IMP_OK);
    if (p->breach == IMP_OK && !(p->lo[2] <= p->hi[2])) p->breach = SURFACE_BAD_DOMAIN;
}

shared_part *part_of_surface(const imp_surface_type *type, void *self)
{
    shared_part *p = malloc(sizeof *p);
    if (p == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *p = (shared_part){.surface = type, .self = self, .holders = 1};
    part_add_label(p, type->name);
    take_domain(p);
    return p;
}

shared_part *part_of_map(const imp_map_type *type, void *self)
{
    shared_part *p = malloc(sizeof *p);
    if (p == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *p = (shared_part){.map = type, .self = self, .holders = 1};
    part_add_label(p, type->name);
    take_times(p);
    return p;
}

shared_part *part_hold(shared_part *p)
{
    p->holders += 1;
    return p;
}

void part_release(shared_part *p)
{
    if (p == NULL) return;
    assert(p->holders > 0);
    if (--p->holders > 0) return;
    if (p->surface != NULL)
        destroy(p->surface->name, p->surface->destroy, p->self);
    else
        destroy(p->map->name, p->map->destroy, p->self);
    free(p);
}

/* --- Labels ------------------------------------------------------------------------- */

void part_label_add(char label[PART_LABEL_MAX], const char *text)
{
    static const char dots[] = " ...";
    const size_t used = strlen(label), more = strlen(text);
    if (used + more + sizeof dots <= PART_LABEL_MAX)
        memcpy(label + used, text, more + 1);
    else if (used < sizeof dots || strcmp(label + used - (sizeof dots - 1), dots) != 0)
        memcpy(label + used, dots, sizeof dots);
}

void part_add_label(shared_part *p, const char *text) { part_label_add(p->label, text); }

/* --- Lists ------------------------------------------------------------------------------ */

bool part_list_add(part_list *list, shared_part *p)
{
    shared_part **grown =
        array_reserve(list->at, list->count, &list->capacity, sizeof(shared_part *));
    if (grown == NULL) return false;
    list->at = grown;
    list->at[list->count++] = part_hold(p);
    return true;
}

bool part_list_add_all(part_list *list, const part_list *more)
{
    for (size_t k = 0; k < more->count; ++k)
        if (!part_list_add(list, more->at[k])) return false;
    return true;
}

void part_list_clear(part_list *list)
{
    for (size_t k = 0; k < list->count; ++k) part_release(list->at[k]);
    free(list->at);
    *list = (part_list){.count = 0};
}
