/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/instance.h"

#include <assert.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "core/surface/surface_internal.h"

/* --- Creation and destruction ----------------------------------------------------------------- */

/* Calls destroy and restores the floating-point mode if it was changed. */
static void destroy(const char *type, void (*destroy_it)(void *), void *self)
{
    const surface_call call = surface_call_begin(type, "destroy");
    destroy_it(self);
    surface_call_end(call, IMP_STATUS_OK);
}

/* Gets a domain, once for each instance. A domain that is infinite in u or v, inverted or NaN
 * breaks the ABI. */
imp_status instance_domain(const imp_surface_type *type, const void *self, double lo[3],
                           double hi[3])
{
    const surface_call call = surface_call_begin(type->name, "domain");
    type->domain(self, lo, hi);
    const imp_status status = surface_call_end(call, IMP_STATUS_OK);
    bool good = lo[0] > -INFINITY && lo[1] > -INFINITY;
    good = good && hi[0] < INFINITY && hi[1] < INFINITY;
    for (int j = 0; j < 3; ++j) good = good && lo[j] <= hi[j];
    return status == IMP_STATUS_OK && !good ? SURFACE_BAD_DOMAIN : status;
}

/* Takes piece k and checks it; p->lo and p->hi are those of the first piece. */
static imp_status take_piece(shared_instance *p, size_t k)
{
    double lo[3], hi[3];
    const surface_call call = surface_call_begin(p->surface->name, "piece");
    p->pieces[k] = p->surface->piece(p->self, k);
    imp_status status = surface_call_end(call, IMP_STATUS_OK);
    if (status != IMP_STATUS_OK) return status;
    if (p->pieces[k] == NULL) return SURFACE_NULL_PIECE;
    status = instance_domain(p->surface, p->pieces[k], lo, hi);
    if (k == 0) {
        memcpy(p->lo, lo, sizeof lo);
        memcpy(p->hi, hi, sizeof hi);
    }
    return status == IMP_STATUS_OK && (lo[2] != p->lo[2] || hi[2] != p->hi[2]) ? SURFACE_PIECE_TIMES
                                                                               : status;
}

/* False: no memory. */
static bool reserve_pieces(shared_instance *p, size_t count)
{
    if (count <= p->piece_room) return true;
    free(p->pieces);
    p->piece_count = 0;
    p->pieces = malloc(count * sizeof *p->pieces);
    p->piece_room = p->pieces != NULL ? count : 0;
    return p->pieces != NULL;
}

/* Takes all pieces. False: no memory. */
static bool take_pieces(shared_instance *p)
{
    const surface_call call = surface_call_begin(p->surface->name, "piece_count");
    const size_t count = p->surface->piece_count(p->self);
    p->piece_count = 0;
    p->breach = surface_call_end(call, IMP_STATUS_OK);
    if (p->breach == IMP_STATUS_OK && (count == 0 || count > IMP_PIECES_MAX))
        p->breach = SURFACE_PIECE_COUNT;
    if (p->breach == IMP_STATUS_OK) {
        if (!reserve_pieces(p, count)) return false;
        p->piece_count = count;
    }
    for (size_t k = 0; k < p->piece_count && p->breach == IMP_STATUS_OK; ++k)
        p->breach = take_piece(p, k);
    if (p->piece_count == 1 && p->pieces[0] == p->self) /* it is its only piece: one surface */
        p->piece_count = 0;
    return true;
}

/* False: no memory. */
static bool add_shelf(shared_instance *p)
{
    if (p->piece_count < 2 || p->shelf != NULL) return true;
    p->shelf = malloc(sizeof *p->shelf);
    if (p->shelf == NULL) return false;
    *p->shelf = (instance_shelf){.lock = PTHREAD_MUTEX_INITIALIZER};
    return true;
}

static void set_span(shared_instance *p, double lo, double hi)
{
    p->span[0] = lo;
    p->span[1] = hi;
}

/* Precondition: the times are known. */
static void take_span(shared_instance *p)
{
    double lo = p->lo[2], hi = p->hi[2];
    if (IMP_OFFERS(p->map, span)) {
        const surface_call call = surface_call_begin(p->map->name, "span");
        p->map->span(p->self, &lo, &hi);
        p->breach = surface_call_end(call, IMP_STATUS_OK);
    }
    if (p->breach == IMP_STATUS_OK && !(lo <= hi)) p->breach = SURFACE_BAD_SPAN;
    set_span(p, lo, hi);
}

static void take_times(shared_instance *p)
{
    p->lo[2] = -INFINITY, p->hi[2] = INFINITY;
    const surface_call call = surface_call_begin(p->map->name, "time_domain");
    p->map->time_domain(p->self, &p->lo[2], &p->hi[2]);
    p->breach = surface_call_end(call, IMP_STATUS_OK);
    if (p->breach == IMP_STATUS_OK && !(p->lo[2] <= p->hi[2])) p->breach = SURFACE_BAD_DOMAIN;
    if (p->breach == IMP_STATUS_OK) take_span(p);
}

static void shelf_clear(instance_shelf *shelf)
{
    for (int k = 0; k < INSTANCE_KEPT_MAX && shelf->kept[k].what != NULL; ++k) {
        shelf->kept[k].release(shelf->kept[k].what);
        shelf->kept[k].what = NULL;
    }
}

void instance_clear_shelf(shared_instance *p)
{
    if (p->shelf != NULL) shelf_clear(p->shelf);
}

static void shelf_free(instance_shelf *shelf)
{
    if (shelf == NULL) return;
    shelf_clear(shelf);
    pthread_mutex_destroy(&shelf->lock);
    free(shelf);
}

/* Takes the domain and the pieces. NULL: no memory, and it is released. */
static shared_instance *take_surface(shared_instance *p)
{
    if (!IMP_OFFERS(p->surface, piece)) {
        p->breach = instance_domain(p->surface, p->self, p->lo, p->hi);
    } else if (!take_pieces(p) || !add_shelf(p)) {
        instance_release(p);
        return NULL;
    }
    set_span(p, p->lo[2], p->hi[2]);
    return p;
}

shared_instance *instance_of_surface(const imp_surface_type *type, void *self)
{
    shared_instance *p = malloc(sizeof *p);
    if (p == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *p = (shared_instance){.surface = type, .self = self, .holders = 1};
    return take_surface(p);
}

fixed_numbers instance_take_numbers(shared_instance *p)
{
    const fixed_numbers numbers = p->numbers;
    p->numbers = (fixed_numbers){.number = NULL};
    return numbers;
}

shared_instance *instance_renewed(shared_instance *p)
{
    assert(p->holders == 1 && p->inner == NULL && p->numbers.number == NULL);
    instance_clear_shelf(p);
    free(p->note);
    free(p->label);
    p->note = p->label = NULL;
    p->note_count = 0;
    p->breach = IMP_STATUS_OK;
    if (p->surface != NULL) return take_surface(p);
    take_times(p);
    return p;
}

shared_instance *instance_of_map(const imp_map_type *type, void *self)
{
    shared_instance *p = malloc(sizeof *p);
    if (p == NULL) {
        destroy(type->name, type->destroy, self);
        return NULL;
    }
    *p = (shared_instance){.map = type, .self = self, .holders = 1};
    take_times(p);
    return p;
}

/* Digits of a label take about twice the bytes of the numbers. */
static size_t bytes_of_label(const shared_instance *p)
{
    return p->given < INSTANCE_LABEL_MAX / 2 ? 2 * p->given : INSTANCE_LABEL_MAX;
}

size_t instance_bytes(const shared_instance *p)
{
    const instance_description *of = p->description;
    return sizeof *p + p->given + bytes_of_label(p) + 4 * INSTANCE_BLOCK +
           p->numbers.count * sizeof *p->numbers.number +
           (of != NULL ? sizeof *of + of->size + INSTANCE_BLOCK : 0) +
           p->piece_count * (sizeof *p->pieces + INSTANCE_PIECE);
}

shared_instance *instance_hold(shared_instance *p)
{
    atomic_fetch_add_explicit(&p->holders, 1, memory_order_relaxed);
    return p;
}

bool instance_is_own(const shared_instance *p)
{
    return atomic_load_explicit(&p->holders, memory_order_acquire) == 1;
}

void instance_shelf_add(instance_shelf *shelf, instance_kept one)
{
    const instance_kept last = shelf->kept[INSTANCE_KEPT_MAX - 1];
    if (last.what != NULL) last.release(last.what);
    memmove(shelf->kept + 1, shelf->kept, (INSTANCE_KEPT_MAX - 1) * sizeof *shelf->kept);
    shelf->kept[0] = one;
}

void instance_release(shared_instance *p)
{
    if (p == NULL) return;
    assert(p->holders > 0);
    if (atomic_fetch_sub_explicit(&p->holders, 1, memory_order_acq_rel) > 1) return;
    shelf_free(p->shelf);
    if (p->surface != NULL)
        destroy(p->surface->name, p->surface->destroy, p->self);
    else
        destroy(p->map->name, p->map->destroy, p->self);
    free(p->pieces);
    free(p->label);
    free(p->named.at);
    free(p->note);
    free(p->numbers.number);
    free(p->description);
    instance_release(p->inner);
    free(p);
}

/* --- Numbers ---------------------------------------------------------------------------------- */

size_t fixed_numbers_of_row(const imp_parameter *row)
{
    size_t count = row->kind == IMP_KIND_NUMBER || row->kind == IMP_KIND_INTEGER ||
                   row->kind == IMP_KIND_BOOLEAN;
    for (uint32_t k = 0; k < row->rank; ++k) count *= row->extent[k];
    return count;
}

const imp_parameter *fixed_numbers_row(const fixed_numbers *numbers, size_t k)
{
    const char *rows = (const char *)numbers->rows;
    return (const imp_parameter *)(const void *)(rows + k * numbers->stride);
}

bool fixed_numbers_copy(fixed_numbers *to, const imp_parameter *rows, size_t row_count,
                        size_t stride, const imp_value *values)
{
    size_t at = 0;
    *to = (fixed_numbers){
        .rows = rows, .row_count = row_count, .stride = stride, .number = to->number};
    for (size_t k = 0; k < row_count; ++k)
        to->count += fixed_numbers_of_row(fixed_numbers_row(to, k));
    if (to->number == NULL) to->number = malloc((to->count + 1) * sizeof *to->number);
    if (to->number == NULL) return false;
    for (size_t k = 0; k < row_count; ++k) {
        const size_t wanted = fixed_numbers_of_row(fixed_numbers_row(to, k));
        for (size_t i = 0; i < wanted; ++i)
            to->number[at++] = i < values[k].count ? values[k].number[i] : NAN;
    }
    return true;
}

/* --- Lists ------------------------------------------------------------------------------------ */

bool instance_list_add(instance_list *list, shared_instance *p)
{
    shared_instance **grown =
        array_reserve(list->at, list->count, &list->capacity, sizeof(shared_instance *));
    if (grown == NULL) return false;
    list->at = grown;
    list->at[list->count++] = instance_hold(p);
    return true;
}

bool instance_list_add_all(instance_list *list, const instance_list *more)
{
    for (size_t k = 0; k < more->count; ++k)
        if (!instance_list_add(list, more->at[k])) return false;
    return true;
}

void instance_list_clear(instance_list *list)
{
    for (size_t k = 0; k < list->count; ++k) instance_release(list->at[k]);
    free(list->at);
    *list = (instance_list){.count = 0};
}
