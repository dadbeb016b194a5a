/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/part.h"

#include <assert.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "core/surface/surface_parts.h"

/* --- Creation and destruction ------------------------------------------------------------ */

/* What destroy does to the floating-point mode is undone. */
static void destroy(const char *type, void (*destroy_it)(void *), void *self)
{
    const surface_call call = surface_call_begin(type, "destroy");
    destroy_it(self);
    surface_call_end(call, IMP_OK);
}

/* Domains are asked for once; one that is not finite in u and v, inverted or NaN is a breach. */
imp_status part_domain(const imp_surface_type *type, const void *self, double lo[3], double hi[3])
{
    const surface_call call = surface_call_begin(type->name, "domain");
    type->domain(self, lo, hi);
    const imp_status status = surface_call_end(call, IMP_OK);
    bool good = lo[0] > -INFINITY && lo[1] > -INFINITY;
    good = good && hi[0] < INFINITY && hi[1] < INFINITY;
    for (int j = 0; j < 3; ++j) good = good && lo[j] <= hi[j];
    return status == IMP_OK && !good ? SURFACE_BAD_DOMAIN : status;
}

bool part_offers_pieces(const imp_surface_type *type)
{
    return type->struct_size >= offsetof(imp_surface_type, piece) + sizeof type->piece &&
           type->piece_count != NULL && type->piece != NULL;
}

bool part_offers_pose(const imp_map_type *type)
{
    return type->struct_size >= offsetof(imp_map_type, rigid) + sizeof type->rigid &&
           type->rigid != NULL;
}

/* One piece, and whether it keeps the rules; p->lo and p->hi are those of the first. */
static imp_status take_piece(shared_part *p, size_t k)
{
    double lo[3], hi[3];
    const surface_call call = surface_call_begin(p->surface->name, "piece");
    p->pieces[k] = p->surface->piece(p->self, k);
    imp_status status = surface_call_end(call, IMP_OK);
    if (status != IMP_OK) return status;
    if (p->pieces[k] == NULL) return SURFACE_NULL_PIECE;
    status = part_domain(p->surface, p->pieces[k], lo, hi);
    if (k == 0) {
        memcpy(p->lo, lo, sizeof lo);
        memcpy(p->hi, hi, sizeof hi);
    }
    return status == IMP_OK && (lo[2] != p->lo[2] || hi[2] != p->hi[2]) ? SURFACE_PIECE_TIMES
                                                                        : status;
}

/* False: no memory. */
static bool take_pieces(shared_part *p)
{
    const surface_call call = surface_call_begin(p->surface->name, "piece_count");
    const size_t count = p->surface->piece_count(p->self);
    p->breach = surface_call_end(call, IMP_OK);
    if (p->breach == IMP_OK && (count == 0 || count > IMP_PIECES_MAX))
        p->breach = SURFACE_PIECE_COUNT;
    if (p->breach == IMP_OK) {
        p->pieces = malloc(count * sizeof *p->pieces);
        if (p->pieces == NULL) return false;
        p->piece_count = count;
    }
    for (size_t k = 0; k < p->piece_count && p->breach == IMP_OK; ++k) p->breach = take_piece(p, k);
    return true;
}

static void take_times(shared_part *p)
{
    p->lo[2] = -INFINITY, p->hi[2] = INFINITY;
    const surface_call call = surface_call_begin(p->map->name, "time_domain");
    p->map->time_domain(p->self, &p->lo[2], &p->hi[2]);
    p->breach = surface_call_end(call, IMP_OK);
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
    if (!part_offers_pieces(type)) {
        p->breach = part_domain(type, self, p->lo, p->hi);
    } else if (!take_pieces(p)) {
        part_release(p);
        return NULL;
    }
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
    take_times(p);
    return p;
}

size_t part_bytes(const shared_part *p)
{
    return sizeof *p + p->given + p->label_size + 3 * PART_BLOCK +
           p->piece_count * sizeof *p->pieces;
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
    free(p->pieces);
    free(p->label);
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

bool part_set_label(shared_part *p, const char label[PART_LABEL_MAX])
{
    const size_t size = strlen(label) + 1;
    p->label = malloc(size);
    if (p->label == NULL) return false;
    memcpy(p->label, label, size);
    p->label_size = size;
    return true;
}

const char *part_label(const shared_part *p)
{
    if (p->label != NULL) return p->label;
    return p->surface != NULL ? p->surface->name : p->map->name;
}

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
