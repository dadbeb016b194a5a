/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/base/active_callback.h"
#include "core/base/status.h"
#include "core/base/text.h"
#include "core/surface/surface_internal.h"

/* --- Composing -------------------------------------------------------------------------------- */

surface *surface_new_of(shared_instance *type) { return surface_new_in(NULL, type); }

surface *surface_new_in(arena_store *store, shared_instance *type)
{
    assert(type->surface != NULL);
    surface *s = arena_store_room(store, sizeof *s);
    if (s == NULL) return NULL;
    *s = (surface){.store = store,
                   .type = type->surface,
                   .self = type->piece_count > 0 ? type->pieces[0] : type->self,
                   .origin = instance_hold(type)};
    memcpy(s->lo, type->lo, sizeof s->lo);
    memcpy(s->hi, type->hi, sizeof s->hi);
    return s;
}

/* Makes room for another map: most surfaces of large scenes have one or two. False: no memory. */
static bool reserve_map(surface *s)
{
    const size_t count = s->map_count, wanted = count < 2 ? 2 : 2 * count;
    if (count < s->map_capacity) return true;
    if (count > SIZE_MAX / 4 / sizeof(mapping)) return false;
    mapping *maps =
        arena_store_regrow(s->store, s->maps, count * sizeof *maps, wanted * sizeof *maps);
    if (maps == NULL) return false;
    s->maps = maps;
    s->map_capacity = wanted;
    return true;
}

imp_code surface_add_instance(surface *s, shared_instance *map)
{
    assert(map->map != NULL);
    if (!reserve_map(s)) return IMP_ERROR_MEMORY;
    s->maps[s->map_count++] = (mapping){map->map, map->self, instance_hold(map)};
    if (map->lo[2] > s->lo[2]) s->lo[2] = map->lo[2];
    if (map->hi[2] < s->hi[2]) s->hi[2] = map->hi[2];
    return IMP_SUCCESS;
}

static piece_table *pieces_new(arena_store *store, size_t count)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, sizeof(surface) + 1, &bytes)) return NULL;
    piece_table *p = arena_store_room(store, sizeof *p + bytes);
    if (p == NULL) return NULL;
    pthread_mutex_init(&p->lock, NULL);
    p->is_made = (void *)(p->at + count);
    for (size_t k = 0; k < count; ++k) atomic_init(&p->is_made[k], false);
    return p;
}

static void pieces_free(arena_store *store, piece_table *p)
{
    if (p == NULL) return;
    pthread_mutex_destroy(&p->lock);
    arena_store_free_room(store, p);
}

surface *surface_new_inner(const surface *s, size_t maps)
{
    assert(maps <= s->map_count);
    surface *inner = arena_store_room(s->store, sizeof *inner);
    if (inner == NULL) return NULL;
    *inner = *s;
    inner->outer = s;
    inner->map_count = maps;
    if (s->pieces == NULL) return inner;
    inner->pieces = pieces_new(s->store, s->piece_count);
    if (inner->pieces != NULL) return inner;
    arena_store_free_room(s->store, inner);
    return NULL;
}

surface *surface_finish(surface *made, bool ok, const surface *s, double slip)
{
    if (ok) memcpy(made->lo, s->lo, sizeof made->lo), memcpy(made->hi, s->hi, sizeof made->hi);
    ok = ok && surface_divide(made) == IMP_SUCCESS;
    if (ok) surface_set_body(made, s->body, s->index), made->held_slip = slip;
    if (ok) return made;
    surface_free(made);
    return NULL;
}

void surface_free(surface *s)
{
    if (s == NULL) return;
    pieces_free(s->store, s->pieces);
    if (s->outer != NULL) {
        arena_store_free_room(s->store, s);
        return;
    }
    for (size_t k = 0; k < s->map_count; ++k) instance_release(s->maps[k].origin);
    arena_store_free_room(s->store, s->maps);
    instance_release(s->origin);
    arena_store_free_room(s->store, s);
}

imp_code surface_divide(surface *s)
{
    if (s->origin->piece_count == 0) return IMP_SUCCESS;
    s->pieces = pieces_new(s->store, s->origin->piece_count);
    if (s->pieces == NULL) return IMP_ERROR_MEMORY;
    s->piece_count = s->origin->piece_count;
    return IMP_SUCCESS;
}

size_t surface_bytes(const surface *s)
{
    size_t bytes = sizeof *s + INSTANCE_BLOCK + s->piece_count * sizeof *s;
    return s->outer != NULL ? bytes : bytes + s->map_capacity * sizeof *s->maps;
}

shared_instance *surface_share(const surface *s) { return instance_hold(s->origin); }

shared_instance *surface_stage(const surface *s, size_t k)
{
    assert(k <= s->map_count);
    return k == 0 ? s->origin : s->maps[k - 1].origin;
}

const shared_instance *surface_origin(const surface *s, size_t k) { return surface_stage(s, k); }

size_t surface_piece_count(const surface *s) { return s->piece_count; }

/* Makes piece k, of an inner surface after that of the surface it belongs to. */
static void make_piece(const surface *s, size_t k, surface *piece)
{
    double lo[3], hi[3];
    *piece = s->outer != NULL ? *surface_piece(s->outer, k) : *s;
    piece->whole = s;
    piece->map_count = s->map_count;
    piece->outer = s->outer != NULL ? surface_piece(s->outer, k) : NULL;
    if (s->outer != NULL) return;
    piece->pieces = NULL;
    piece->piece_count = 0;
    piece->self = s->origin->pieces[k];
    if (instance_domain(s->type, piece->self, lo, hi) != IMP_STATUS_OK)
        return; /* checked when its instance was made */
    memcpy(piece->lo, lo, 2 * sizeof *lo);
    memcpy(piece->hi, hi, 2 * sizeof *hi);
}

const surface *surface_piece(const surface *s, size_t k)
{
    assert(k < s->piece_count);
    piece_table *pieces = s->pieces;
    if (!atomic_load_explicit(&pieces->is_made[k], memory_order_acquire)) {
        pthread_mutex_lock(&pieces->lock);
        if (!atomic_load_explicit(&pieces->is_made[k], memory_order_relaxed))
            make_piece(s, k, &pieces->at[k]);
        atomic_store_explicit(&pieces->is_made[k], true, memory_order_release);
        pthread_mutex_unlock(&pieces->lock);
    }
    return &pieces->at[k];
}

enum { PIECES_FEW = 8 };

bool surface_is_whole(const surface *s, const imp_region *region)
{
    if (s->whole != NULL && s->whole->piece_count > PIECES_FEW) return false;
    for (int j = 0; j < 2; ++j)
        if (region->lo[j] > s->lo[j] || region->hi[j] < s->hi[j]) return false;
    return true;
}

size_t surface_piece_index(const surface *s)
{
    return s->whole != NULL ? (size_t)(s - s->whole->pieces->at) : 0;
}

void surface_set_body(surface *s, const char *body, size_t index)
{
    s->body = body;
    s->index = index;
    for (size_t k = 0; k < s->piece_count; ++k)
        if (s->pieces->is_made[k]) surface_set_body(&s->pieces->at[k], body, index);
}

/* Names the type and all maps, including those that an inner surface leaves out. */
static void label_of(const surface *s, char label[INSTANCE_LABEL_MAX])
{
    const surface *whole = s->outer != NULL ? s->outer : s;
    label[0] = '\0';
    for (size_t k = 0; k <= whole->map_count; ++k) {
        char own[INSTANCE_LABEL_MAX];
        if (k > 0) instance_label_add(label, " ! ");
        instance_label(k == 0 ? whole->origin : whole->maps[k - 1].origin, own);
        instance_label_add(label, own);
    }
}

imp_code surface_fault(const surface *s, imp_error *error, const char *format, ...)
{
    if (error == NULL) return IMP_ERROR_PLUGIN;
    char what[sizeof error->text], label[INSTANCE_LABEL_MAX];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    label_of(s, label);
    error_set(error, IMP_ERROR_PLUGIN, "type '%s'%s%s", label, what[0] == ':' ? "" : " ", what);
    if (s->whole != NULL) error_prefix(error, "piece %zu", surface_piece_index(s));
    if (s->body != NULL) error_prefix(error, "body '%.80s', surface %zu", s->body, s->index);
    text_clean(error->text);
    return IMP_ERROR_PLUGIN;
}

void surface_domain(const surface *s, double lo[3], double hi[3])
{
    memcpy(lo, s->lo, sizeof s->lo);
    memcpy(hi, s->hi, sizeof s->hi);
}

/* --- Times ------------------------------------------------------------------------------------ */

bool surface_instance_at(const surface *s, size_t k, surface_instance *found)
{
    if (k > s->map_count) return false;
    const shared_instance *p = k == 0 ? s->origin : s->maps[k - 1].origin;
    const uint32_t flags = p->surface != NULL ? p->surface->flags : p->map->flags;
    const bool has_order_2 = p->surface != NULL ? p->surface->include != NULL
                                                : p->map->apply != NULL || p->map->rigid != NULL;
    *found = (surface_instance){.name = p->surface != NULL ? p->surface->name : p->map->name,
                                .lo = p->lo[2],
                                .hi = p->hi[2],
                                .span = {p->span[0], p->span[1]},
                                .absent = flags & IMP_FLAG_ABSENT_OUTSIDE_TIMES,
                                .has_order_2 = has_order_2};
    return true;
}

void surface_existence(const surface *s, double *lo, double *hi)
{
    surface_instance x;
    *lo = -INFINITY, *hi = INFINITY;
    for (size_t k = 0; surface_instance_at(s, k, &x); ++k) {
        if (x.absent && x.lo > *lo) *lo = x.lo;
        if (x.absent && x.hi < *hi) *hi = x.hi;
    }
}

bool surface_undefined_instance(const surface *s, double lo, double hi, surface_instance *found)
{
    for (size_t k = 0; surface_instance_at(s, k, found); ++k)
        if (!found->absent && (found->lo > lo || found->hi < hi)) return true;
    return false;
}
