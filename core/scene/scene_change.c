/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_change.h"

#include <assert.h>
#include <math.h>

#include "core/scene/scene_internal.h"

/* --- Where instances stand -------------------------------------------------------------------- */

/* Counts the maps of a body and of those above it. */
static size_t maps_of_bodies(const imp_scene *scene, size_t body)
{
    size_t count = 0;
    for (; body != SIZE_MAX; body = scene->layout[body].parent)
        count += scene->layout[body].maps.count;
    return count;
}

size_t scene_own_maps(const imp_scene *scene, size_t body, size_t k)
{
    const size_t all = surface_map_count(scene->bodies[body].members[k].surface);
    return scene->layout != NULL ? all - maps_of_bodies(scene, body) : all;
}

/* Returns a surface's own map that is equal to this one; NULL: none. */
static shared_instance *own_equal_map(const surface *s, size_t of_bodies,
                                      const shared_instance *map)
{
    const size_t all = surface_map_count(s);
    for (size_t j = 1; j + of_bodies <= all; ++j) {
        shared_instance *one = surface_stage(s, j);
        if (instance_is_equal_map(one, map)) return one;
    }
    return NULL;
}

shared_instance *scene_stage_at(const imp_scene *scene, scene_stage at)
{
    if (at.body >= scene->count || scene->layout == NULL) return NULL;
    const scene_body *b = &scene->bodies[at.body];
    const instance_list *maps = &scene->layout[at.body].maps;
    if (at.surface == SIZE_MAX) return at.map < maps->count ? maps->at[at.map] : NULL;
    if (at.surface >= b->count) return NULL;
    const member *m = &b->members[at.surface];
    if (at.map == SIZE_MAX) return surface_stage(m->surface, 0);
    return at.map < scene_own_maps(scene, at.body, at.surface)
               ? surface_stage(m->surface, 1 + at.map)
               : NULL;
}

static shared_instance *search_equal_map(const imp_scene *scene, const shared_instance *map)
{
    for (size_t b = 0; b < scene->count; ++b) {
        const scene_body *body = &scene->bodies[b];
        const instance_list *maps = &scene->layout[b].maps;
        const size_t of_bodies = maps_of_bodies(scene, b);
        for (size_t k = 0; k < maps->count; ++k)
            if (instance_is_equal_map(maps->at[k], map)) return maps->at[k];
        for (size_t k = 0; k < body->count; ++k) {
            shared_instance *one = own_equal_map(body->members[k].surface, of_bodies, map);
            if (one != NULL) return one;
        }
    }
    return NULL;
}

/* --- The index of maps ------------------------------------------------------------------------ */

/* In scenes of fewer bodies a search takes no longer than the hash of a slot. */
enum { INDEXED_BODIES = 16 };

/* Adds a map, or gives the index up. */
static void index_map(imp_scene *scene, shared_instance *map)
{
    map_index *index = &scene->maps;
    if (map->map == NULL || map->description == NULL || scene->cannot_index) return;
    scene->bytes -= map_index_bytes(index);
    if (!map_index_add(index, map)) {
        map_index_clear(index);
        scene->cannot_index = true;
        scene->indexes_maps = false;
    }
    scene->bytes += map_index_bytes(index);
}

/* Adds all maps of a scene of many bodies when it is first changed. */
static void begin_index(imp_scene *scene)
{
    if (scene->indexes_maps || scene->cannot_index || scene->count < INDEXED_BODIES) return;
    scene->indexes_maps = true;
    for (size_t b = 0; b < scene->count; ++b) {
        const scene_body *body = &scene->bodies[b];
        const instance_list *maps = &scene->layout[b].maps;
        for (size_t k = 0; k < maps->count; ++k) index_map(scene, maps->at[k]);
        for (size_t k = 0; k < body->count; ++k)
            for (size_t j = scene_own_maps(scene, b, k); j > 0; --j)
                index_map(scene, surface_stage(body->members[k].surface, j));
    }
}

shared_instance *scene_equal_map(imp_scene *scene, const shared_instance *map)
{
    if (map->description == NULL) return NULL;
    begin_index(scene);
    return scene->indexes_maps ? map_index_find(&scene->maps, map) : search_equal_map(scene, map);
}

/* Returns where the instance at `at` stands in a surface of a body, as surface_stage counts;
 * SIZE_MAX: nowhere. */
static size_t stage_within(const imp_scene *scene, size_t body, size_t index, scene_stage at)
{
    if (at.surface != SIZE_MAX) {
        if (body != at.body || index != at.surface) return SIZE_MAX;
        return at.map == SIZE_MAX ? 0 : 1 + at.map;
    }
    size_t stage = 1 + scene_own_maps(scene, body, index) + at.map, up = body;
    for (; up != at.body && up != SIZE_MAX; up = scene->layout[up].parent)
        stage += scene->layout[up].maps.count;
    return up == at.body ? stage : SIZE_MAX;
}

/* --- Composing anew --------------------------------------------------------------------------- */

typedef struct recomposed {
    member *of;
    surface *other; /* the new one until they are exchanged, then the old one */
} recomposed;

typedef struct change {
    recomposed *at;
    size_t count;
    bool times_differ;
} change;

/* The surface with another instance at that stage. NULL: no memory. */
static surface *compose(const imp_scene *scene, const surface *s, size_t stage, shared_instance *by)
{
    surface *made = surface_new_in(scene->store, stage == 0 ? by : surface_stage(s, 0));
    for (size_t k = 1; made != NULL && k <= surface_map_count(s); ++k)
        if (surface_add_instance(made, k == stage ? by : surface_stage(s, k)) != IMP_SUCCESS) {
            surface_free(made);
            return NULL;
        }
    if (made == NULL || surface_divide(made) == IMP_SUCCESS) return made;
    surface_free(made);
    return NULL;
}

static bool have_other_times(const surface *x, const surface *y)
{
    double lo[2][3], hi[2][3];
    surface_domain(x, lo[0], hi[0]);
    surface_domain(y, lo[1], hi[1]);
    return lo[0][2] != lo[1][2] || hi[0][2] != hi[1][2];
}

/* Adds the surfaces of one body that have the instance. False: no memory. */
static bool recompose_body(imp_scene *scene, size_t body, scene_stage at, shared_instance *by,
                           change *c)
{
    scene_body *b = &scene->bodies[body];
    for (size_t k = 0; k < b->count; ++k) {
        const size_t stage = stage_within(scene, body, k, at);
        if (stage == SIZE_MAX) continue;
        surface *made = compose(scene, b->members[k].surface, stage, by);
        if (made == NULL) return false;
        surface_set_body(made, b->name, k);
        c->times_differ |= have_other_times(b->members[k].surface, made);
        c->at[c->count++] = (recomposed){&b->members[k], made};
    }
    return true;
}

/* Returns the first and the last body that may have the instance. */
static void find_bodies(const imp_scene *scene, scene_stage at, size_t *first, size_t *last)
{
    const bool is_inherited = at.surface == SIZE_MAX && scene->layout[at.body].is_parent;
    *first = is_inherited ? 0 : at.body;
    *last = is_inherited ? scene->count - 1 : at.body;
}

/* False: no memory. */
static bool recompose(imp_scene *scene, scene_stage at, shared_instance *by, change *c)
{
    size_t first, last, most = 0;
    find_bodies(scene, at, &first, &last);
    for (size_t b = first; b <= last; ++b) most += scene->bodies[b].count;
    c->at = arena_store_room(scene->store, (most + 1) * sizeof *c->at);
    if (c->at == NULL) return false;
    for (size_t b = first; b <= last; ++b)
        if (!recompose_body(scene, b, at, by, c)) return false;
    return true;
}

static void exchange(change *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        recomposed *r = &c->at[k];
        surface *other = r->other;
        r->other = r->of->surface;
        r->of->surface = other;
    }
}

static void clear(const imp_scene *scene, change *c)
{
    for (size_t k = 0; k < c->count; ++k) surface_free(c->at[k].other);
    arena_store_free_room(scene->store, c->at);
}

/* --- Exchanging ------------------------------------------------------------------------------- */

/* Takes the remarks of the scene as it is now. False: no memory, and they stay. */
static bool renew_remarks(imp_scene *scene)
{
    scene_remarks fresh = {.count = 0};
    if (!scene_note_remarks(scene, &fresh)) {
        scene_remarks_clear(&fresh);
        return false;
    }
    scene_remarks_clear(&scene->remarks);
    scene->remarks = fresh;
    return true;
}

static bool have_other_spans(const shared_instance *x, const shared_instance *y)
{
    return x->lo[2] != y->lo[2] || x->hi[2] != y->hi[2] || x->span[0] != y->span[0] ||
           x->span[1] != y->span[1];
}

static bool has_map(const instance_list *maps, const shared_instance *p)
{
    for (size_t k = 0; k < maps->count; ++k)
        if (maps->at[k] == p) return true;
    return false;
}

static bool has_instance(const imp_scene *scene, const shared_instance *p)
{
    for (size_t b = 0; b < scene->count; ++b) {
        const scene_body *body = &scene->bodies[b];
        if (has_map(&scene->layout[b].maps, p)) return true;
        for (size_t k = 0; k < body->count; ++k)
            for (size_t j = 0; j <= surface_map_count(body->members[k].surface); ++j)
                if (surface_stage(body->members[k].surface, j) == p) return true;
    }
    return false;
}

/* Whether an instance that the caller holds is not in the scene. Most are held by nobody else, so
 * that the scene is not searched. */
static bool is_elsewhere(const imp_scene *scene, const shared_instance *p)
{
    return instance_is_own(p) || !has_instance(scene, p);
}

/* Changes the sum of bytes by that of the surfaces exchanged. */
static void settle_bytes(imp_scene *scene, const change *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        scene->bytes += surface_bytes(c->at[k].of->surface);
        scene->bytes -= surface_bytes(c->at[k].other);
    }
}

static void add_instance(imp_scene *scene, shared_instance *p)
{
    scene->bytes += instance_bytes(p);
    if (scene->indexes_maps) index_map(scene, p);
}

static void remove_instance(imp_scene *scene, const shared_instance *p)
{
    scene->bytes -= instance_bytes(p);
    if (scene->indexes_maps && p->map != NULL && p->description != NULL)
        map_index_remove(&scene->maps, p);
}

/* Does what cannot fail any more. Trees lie in the surfaces that they are of, and go first. */
static void settle(imp_scene *scene, const shared_instance *from, const shared_instance *to,
                   const change *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        member *m = c->at[k].of;
        scene_free_trees(scene, m);
        m->trees = NULL;
        m->inners = NULL;
    }
    settle_bytes(scene, c);
    if (c->times_differ) scene_note_times(scene);
    if (have_other_spans(from, to)) scene_choose_times(scene);
}

imp_code scene_replace(imp_scene *scene, scene_stage at, shared_instance *by)
{
    shared_instance *from = scene_stage_at(scene, at);
    assert(from != NULL && scene_users(scene) == 0);
    if (from == by) return IMP_SUCCESS;
    change c = {.count = 0};
    const bool is_new = is_elsewhere(scene, by);
    bool done = recompose(scene, at, by, &c);
    if (done) exchange(&c);
    if (done && (from->note_count > 0 || by->note_count > 0) && !renew_remarks(scene)) {
        exchange(&c);
        done = false;
    }
    if (done) {
        settle(scene, from, by, &c);
        if (at.surface == SIZE_MAX) {
            scene->layout[at.body].maps.at[at.map] = instance_hold(by);
            instance_release(from);
        }
        if (is_new) add_instance(scene, by);
    }
    clear(scene, &c); /* which releases the other surfaces' hold of `from` */
    if (done && is_elsewhere(scene, from)) remove_instance(scene, from);
    return done ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

size_t scene_users(const imp_scene *scene) { return scene->references - 1; }
