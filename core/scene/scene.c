/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene.h"

#include <assert.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/common/array.h"
#include "core/scene/default_times.h"
#include "core/scene/key_pairs.h"
#include "core/scene/scene_remarks.h"
#include "core/scene/scene_trees.h"

/* A surface without its last maps, for trees in a frame that moves with these. */
typedef struct inner {
    struct inner *next;
    surface *surface;
    size_t left_out;
} inner;

typedef struct member {
    surface *surface;
    /* the first of either list, to whose front threads add */
    _Atomic(tree *) trees;
    _Atomic(inner *) inners;
} member;

typedef struct scene_body {
    char *name;
    bool solid;
    member *members;
    size_t count, capacity;
    size_t *groups;
    size_t group_count, group_capacity;
} scene_body;

struct imp_scene {
    scene_body *bodies;
    size_t count, capacity;
    size_t solids; /* how many bodies are solid */
    char **groups; /* names */
    size_t group_count, group_capacity;
    key_pairs ignored;
    scene_settings settings;
    scene_parameters parameters;
    uint64_t bytes;      /* 0: not summed up yet */
    double t_from, t_to; /* when all surfaces are defined; not known yet: never */
    scene_remarks remarks;
    arena_store *store; /* of blocks for trees; not its own; NULL: the heap */
    /* once it is built all but the members' lists of trees is only read */
};

/* --- Building --------------------------------------------------------------------------------- */

imp_scene *scene_new(void)
{
    imp_scene *scene = calloc(1, sizeof *scene);
    if (scene == NULL) return NULL;
    scene->settings = (scene_settings){NAN, NAN, 1e-6, -1};
    scene->t_from = INFINITY, scene->t_to = -INFINITY;
    return scene;
}

static void inner_free(inner *i)
{
    surface_free(i->surface);
    free(i);
}

static void member_free(member *m)
{
    for (tree *t = m->trees, *next; t != NULL; t = next) {
        next = tree_next(t);
        tree_free(t);
    }
    for (inner *i = m->inners, *next; i != NULL; i = next) {
        next = i->next;
        inner_free(i);
    }
    surface_free(m->surface);
}

void imp_scene_free(imp_scene *scene)
{
    if (scene == NULL) return;
    for (size_t b = 0; b < scene->count; ++b) {
        for (size_t k = 0; k < scene->bodies[b].count; ++k)
            member_free(&scene->bodies[b].members[k]);
        free(scene->bodies[b].members);
        free(scene->bodies[b].groups);
        free(scene->bodies[b].name);
    }
    for (size_t g = 0; g < scene->group_count; ++g) free(scene->groups[g]);
    free(scene->groups);
    free(scene->bodies);
    scene_remarks_clear(&scene->remarks);
    key_pairs_clear(&scene->ignored);
    scene_parameters_clear(&scene->parameters);
    free(scene);
}

static bool note_remarks(imp_scene *scene)
{
    bool kept = true;
    for (size_t b = 0; b < scene->count && kept; ++b)
        for (size_t k = 0; k < scene->bodies[b].count && kept; ++k)
            kept = scene_remarks_add(&scene->remarks, scene->bodies[b].members[k].surface, b, k);
    return kept;
}

imp_code scene_add_body(imp_scene *scene, const char *name)
{
    scene_body *bodies =
        array_reserve(scene->bodies, scene->count, &scene->capacity, sizeof *bodies);
    if (bodies == NULL) return IMP_ERROR_MEMORY;
    scene->bodies = bodies;
    char *copy = strdup(name);
    if (copy == NULL) return IMP_ERROR_MEMORY;
    bodies[scene->count++] = (scene_body){.name = copy};
    return IMP_SUCCESS;
}

void scene_set_store(imp_scene *scene, arena_store *store) { scene->store = store; }

arena_store *scene_store(const imp_scene *scene) { return scene->store; }

void scene_set_solid(imp_scene *scene, size_t body, bool is_solid)
{
    assert(body < scene->count);
    scene->solids += is_solid;
    scene->solids -= scene->bodies[body].solid;
    scene->bodies[body].solid = is_solid;
}

bool scene_has_solids(const imp_scene *scene) { return scene->solids > 0; }

bool scene_is_solid(const imp_scene *scene, size_t body)
{
    assert(body < scene->count);
    return scene->bodies[body].solid;
}

imp_code scene_add_surface(imp_scene *scene, size_t index, surface *s)
{
    assert(index < scene->count);
    scene_body *b = &scene->bodies[index];
    member *members = array_reserve(b->members, b->count, &b->capacity, sizeof *members);
    if (members == NULL) {
        surface_free(s);
        return IMP_ERROR_MEMORY;
    }
    if (surface_divide(s) != IMP_SUCCESS) {
        surface_free(s);
        b->members = members;
        return IMP_ERROR_MEMORY;
    }
    surface_set_body(s, b->name, b->count);
    members[b->count++] = (member){.surface = s};
    b->members = members;
    return IMP_SUCCESS;
}

/* --- Groups ----------------------------------------------------------------------------------- */

imp_code scene_add_group(imp_scene *scene, const char *name)
{
    char **grown =
        array_reserve(scene->groups, scene->group_count, &scene->group_capacity, sizeof *grown);
    if (grown == NULL) return IMP_ERROR_MEMORY;
    scene->groups = grown;
    grown[scene->group_count] = strdup(name);
    if (grown[scene->group_count] == NULL) return IMP_ERROR_MEMORY;
    scene->group_count += 1;
    return IMP_SUCCESS;
}

size_t scene_group_count(const imp_scene *scene) { return scene->group_count; }

const char *scene_group_name(const imp_scene *scene, size_t group)
{
    return group < scene->group_count ? scene->groups[group] : NULL;
}

imp_code scene_join(imp_scene *scene, size_t index, size_t group)
{
    assert(index < scene->count && group < scene->group_count);
    scene_body *b = &scene->bodies[index];
    size_t *grown = array_reserve(b->groups, b->group_count, &b->group_capacity, sizeof *grown);
    if (grown == NULL) return IMP_ERROR_MEMORY;
    b->groups = grown;
    b->groups[b->group_count++] = group;
    return IMP_SUCCESS;
}

/* --- Who ignores whom ------------------------------------------------------------------------- */

/* Returns the key of a body (even) or of a group (odd). */
static size_t key_of(scene_members m) { return 2 * m.index + m.is_group; }

imp_code scene_ignore_members(imp_scene *scene, scene_members x, scene_members y)
{
    return key_pairs_add(&scene->ignored, key_of(x), key_of(y)) ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

bool scene_key_is_of_body(size_t key) { return key % 2 == 0; }

size_t scene_body_key_count(const imp_scene *scene, size_t body)
{
    return 1 + scene->bodies[body].group_count;
}

size_t scene_body_key(const imp_scene *scene, size_t body, size_t k)
{
    if (k == 0) return key_of((scene_members){false, body});
    return key_of((scene_members){true, scene->bodies[body].groups[k - 1]});
}

const key_pairs *scene_ignored(const imp_scene *scene) { return &scene->ignored; }

bool scene_ignores(const imp_scene *scene, size_t a, size_t b)
{
    if (scene->ignored.count == 0) return false;
    for (size_t j = 0; j <= scene->bodies[a].group_count; ++j)
        for (size_t k = 0; k <= scene->bodies[b].group_count; ++k)
            if (key_pairs_have(&scene->ignored, scene_body_key(scene, a, j),
                               scene_body_key(scene, b, k)))
                return true;
    return false;
}

static imp_code copy_groups(const imp_scene *from, imp_scene *to)
{
    imp_code code = IMP_SUCCESS;
    for (size_t g = 0; g < from->group_count && code == IMP_SUCCESS; ++g)
        code = scene_add_group(to, from->groups[g]);
    for (size_t b = 0; b < from->count; ++b)
        for (size_t k = 0; k < from->bodies[b].group_count && code == IMP_SUCCESS; ++k)
            code = scene_join(to, b, from->bodies[b].groups[k]);
    return code;
}

imp_code scene_copy_relations(const imp_scene *from, imp_scene *to)
{
    assert(from->count == to->count);
    imp_code code = copy_groups(from, to);
    for (size_t k = 0; k < from->ignored.count && code == IMP_SUCCESS; ++k) {
        const size_t *key = from->ignored.at[k].key;
        if (!key_pairs_add(&to->ignored, key[0], key[1])) code = IMP_ERROR_MEMORY;
    }
    return code;
}

/* --- Memory ----------------------------------------------------------------------------------- */

static uint64_t sum_of_bytes(const imp_scene *scene)
{
    uint64_t bytes = sizeof *scene + scene->capacity * sizeof *scene->bodies +
                     scene->group_count * sizeof *scene->groups +
                     scene->ignored.capacity * sizeof *scene->ignored.at;
    for (size_t b = 0; b < scene->count; ++b) {
        const scene_body *body = &scene->bodies[b];
        bytes += strlen(body->name) + 1 + body->capacity * sizeof *body->members +
                 body->group_capacity * sizeof *body->groups + 2 * INSTANCE_BLOCK;
        for (size_t k = 0; k < body->count; ++k) bytes += surface_bytes(body->members[k].surface);
    }
    return bytes;
}

uint64_t scene_bytes(const imp_scene *scene)
{
    return scene->bytes > 0 ? scene->bytes : sum_of_bytes(scene);
}

/* --- Once it is built ------------------------------------------------------------------------- */

static void note_times(imp_scene *scene)
{
    scene->t_from = -INFINITY, scene->t_to = INFINITY;
    for (size_t b = 0; b < scene->count; ++b)
        for (size_t k = 0; k < scene->bodies[b].count; ++k) {
            double lo[3], hi[3];
            surface_domain(scene->bodies[b].members[k].surface, lo, hi);
            if (!(lo[2] <= scene->t_from)) scene->t_from = lo[2];
            if (!(hi[2] >= scene->t_to)) scene->t_to = hi[2];
        }
}

imp_code scene_complete(imp_scene *scene)
{
    scene_settings *set = &scene->settings;
    double time[2];
    scene->bytes = sum_of_bytes(scene);
    note_times(scene);
    if (!note_remarks(scene)) return IMP_ERROR_MEMORY;
    if (!isnan(set->t_start) || default_times(scene, time, NULL) != IMP_SUCCESS) return IMP_SUCCESS;
    set->t_start = time[0];
    set->t_end = time[1];
    return IMP_SUCCESS;
}

bool imp_scene_remark(const imp_scene *scene, size_t index, imp_remark *remark)
{
    return scene != NULL && scene_remarks_tell(&scene->remarks, index, remark);
}

bool scene_is_defined(const imp_scene *scene, double t_start, double t_end)
{
    return scene->t_from <= t_start && t_end <= scene->t_to;
}

/* --- Asking ----------------------------------------------------------------------------------- */

scene_settings *scene_settings_of(imp_scene *scene) { return &scene->settings; }

const scene_settings *scene_settings_read(const imp_scene *scene) { return &scene->settings; }

scene_parameters *scene_parameters_of(imp_scene *scene) { return &scene->parameters; }

const scene_parameters *scene_parameters_read(const imp_scene *scene) { return &scene->parameters; }

imp_code scene_refuse_parameters(const imp_scene *scene, const char *asker, imp_error *error)
{
    if (scene->parameters.count == 0) return IMP_SUCCESS;
    return error_set(
        error, IMP_ERROR_USAGE,
        "the scene has parameters ('%.80s'), and %s asks about one pose: ask about all "
        "values (impinge solve, impinge clearance; imp_survey_new), or about the "
        "scene at some (imp_scene_at)",
        scene->parameters.at[0].name, asker);
}

size_t imp_scene_parameter_count(const imp_scene *scene)
{
    return scene != NULL ? scene->parameters.count : 0;
}

bool imp_scene_parameter(const imp_scene *scene, size_t index, imp_scene_parameter_info *info)
{
    if (index >= imp_scene_parameter_count(scene) || info == NULL) return false;
    const scene_parameter *p = &scene->parameters.at[index];
    *info = (imp_scene_parameter_info){p->name, p->lo, p->hi, p->is_followed};
    return true;
}

size_t scene_body_count(const imp_scene *scene) { return scene->count; }

size_t scene_surface_count(const imp_scene *scene, size_t body)
{
    assert(body < scene->count);
    return scene->bodies[body].count;
}

size_t imp_scene_body_count(const imp_scene *scene) { return scene != NULL ? scene->count : 0; }

bool imp_scene_ignores(const imp_scene *scene, size_t a, size_t b)
{
    const size_t bodies = imp_scene_body_count(scene);
    if (a >= bodies || b >= bodies) return false;
    if (scene->bodies[a].count == 0 || scene->bodies[b].count == 0) return true;
    return scene_ignores(scene, a, b);
}

const char *imp_scene_body_name(const imp_scene *scene, size_t body)
{
    return body < imp_scene_body_count(scene) ? scene->bodies[body].name : NULL;
}

size_t imp_scene_surface_count(const imp_scene *scene, size_t body)
{
    return body < imp_scene_body_count(scene) ? scene->bodies[body].count : 0;
}

const surface *scene_surface(const imp_scene *scene, size_t body, size_t index)
{
    if (scene == NULL || body >= scene->count || index >= scene->bodies[body].count) return NULL;
    return scene->bodies[body].members[index].surface;
}

size_t imp_scene_piece_count(const imp_scene *scene, size_t body, size_t index)
{
    const surface *s = scene_surface(scene, body, index);
    if (s == NULL) return 0;
    return surface_piece_count(s) > 0 ? surface_piece_count(s) : 1;
}

/* NULL: there is none. */
static const surface *piece_at(const imp_scene *scene, imp_place at)
{
    const surface *s = scene_surface(scene, at.body, at.surface);
    if (s == NULL || at.piece >= imp_scene_piece_count(scene, at.body, at.surface)) return NULL;
    return surface_piece_count(s) > 0 ? surface_piece(s, at.piece) : s;
}

/* Sets the error for a callback's status. A place outside the domain is the caller's fault. */
static imp_code refusal(const surface *s, imp_status status, imp_error *why)
{
    surface_fault(
        s, why, ": %s",
        status == IMP_STATUS_DOMAIN
            ? "is undefined there, or too large for a double, though that lies in its domain"
            : surface_status_told(s, status).text);
    if (status != IMP_STATUS_DOMAIN) return surface_set_code(status, why);
    if (why != NULL) why->code = IMP_ERROR_USAGE;
    return IMP_ERROR_USAGE;
}

/* Sets the error for the first of n points that lies outside the domain. IMP_SUCCESS: all lie
 * inside. */
static imp_code refuse_outside(const surface *s, size_t n, const double *p, imp_error *why)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    for (; n > 0; --n, p += 3) {
        bool inside = true;
        for (int j = 0; j < 3; ++j) inside = inside && lo[j] <= p[j] && p[j] <= hi[j];
        if (inside) continue;
        surface_fault(s, why,
                      ": got (u, v, t) = (%g, %g, %g), must be in its domain, u in [%g, %g], "
                      "v in [%g, %g], t in [%g, %g]",
                      p[0], p[1], p[2], lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
        if (why != NULL) why->code = IMP_ERROR_USAGE;
        return IMP_ERROR_USAGE;
    }
    return IMP_SUCCESS;
}

static imp_code no_surface(const imp_scene *scene, imp_place at, imp_error *why)
{
    const size_t pieces = imp_scene_piece_count(scene, at.body, at.surface);
    if (pieces > 0)
        return error_set(why, IMP_ERROR_USAGE, "body %zu, surface %zu has no piece %zu, but %zu",
                         at.body, at.surface, at.piece, pieces);
    return error_set(why, IMP_ERROR_USAGE, "body %zu has no surface %zu", at.body, at.surface);
}

FP_APART static imp_code eval(const imp_scene *scene, imp_place at, size_t n, const double *p,
                              double *x, double *error, imp_error *why)
{
    const surface *s = piece_at(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    const imp_status status = surface_eval(s, n, p, x, error);
    if (status == IMP_STATUS_DOMAIN && refuse_outside(s, n, p, why) != IMP_SUCCESS)
        return IMP_ERROR_USAGE;
    return status == IMP_STATUS_OK ? IMP_SUCCESS : refusal(s, status, why);
}

static bool is_inside(const surface *s, const double lo[3], const double hi[3])
{
    double from[3], to[3];
    surface_domain(s, from, to);
    for (int j = 0; j < 3; ++j)
        if (!(lo[j] >= from[j] && lo[j] <= hi[j] && hi[j] <= to[j] && isfinite(lo[j]) &&
              isfinite(hi[j])))
            return false;
    return true;
}

FP_APART static imp_code include(const imp_scene *scene, imp_place at, const double lo[3],
                                 const double hi[3], imp_model model[3], imp_error *why)
{
    const surface *s = piece_at(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    if (!is_inside(s, lo, hi))
        return error_set(why, IMP_ERROR_USAGE,
                         "body %zu, surface %zu: region (%g..%g, %g..%g, %g..%g), must be finite "
                         "and inside the domain",
                         at.body, at.surface, lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
    const imp_region region = region_make(lo, hi);
    const imp_status status = surface_include(s, &region, model);
    return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED ? IMP_SUCCESS
                                                                     : refusal(s, status, why);
}

imp_code imp_piece_eval(const imp_scene *scene, imp_place at, size_t n, const double *p, double *x,
                        double *error, imp_error *why)
{
    if (scene == NULL || p == NULL || x == NULL) return error_set_missing(why, "imp_scene_eval");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = eval(scene, at, n, p, x, error, why);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_scene_eval(const imp_scene *scene, size_t body, size_t index, size_t n,
                        const double *p, double *x, double *error, imp_error *why)
{
    return imp_piece_eval(scene, (imp_place){body, index, 0}, n, p, x, error, why);
}

imp_code imp_piece_include(const imp_scene *scene, imp_place at, const double lo[3],
                           const double hi[3], imp_model model[3], imp_error *why)
{
    if (scene == NULL || lo == NULL || hi == NULL || model == NULL)
        return error_set_missing(why, "imp_scene_include");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = include(scene, at, lo, hi, model, why);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_scene_include(const imp_scene *scene, size_t body, size_t index, const double lo[3],
                           const double hi[3], imp_model model[3], imp_error *why)
{
    return imp_piece_include(scene, (imp_place){body, index, 0}, lo, hi, model, why);
}

FP_APART static imp_code piece_motion(const imp_scene *scene, imp_place at, double from, double to,
                                      imp_rigid_motion *motion, imp_error *why)
{
    double lo[3], hi[3];
    const surface *s = piece_at(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    surface_domain(s, lo, hi);
    const double first = from < to ? from : to, last = from < to ? to : from;
    if (!(lo[2] <= first && last <= hi[2] && isfinite(first) && isfinite(last)))
        return error_set(
            why, IMP_ERROR_USAGE,
            "body %zu, surface %zu: times %g and %g, must be finite and in the domain, "
            "from %g to %g",
            at.body, at.surface, from, to, lo[2], hi[2]);
    surface_motion(s, from, to, motion);
    return IMP_SUCCESS;
}

imp_code imp_piece_motion(const imp_scene *scene, imp_place at, double from, double to,
                          imp_rigid_motion *motion, imp_error *why)
{
    if (scene == NULL || motion == NULL) return error_set_missing(why, "imp_piece_motion");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = piece_motion(scene, at, from, to, motion, why);
    fp_environment_leave(&environment);
    return code;
}

void imp_piece_domain(const imp_scene *scene, imp_place at, double lo[3], double hi[3])
{
    const surface *s = piece_at(scene, at);
    if (lo == NULL || hi == NULL) return;
    for (int j = 0; j < 3; ++j) lo[j] = INFINITY, hi[j] = -INFINITY;
    if (s != NULL) surface_domain(s, lo, hi);
}

void imp_scene_domain(const imp_scene *scene, size_t body, size_t index, double lo[3], double hi[3])
{
    imp_piece_domain(scene, (imp_place){body, index, 0}, lo, hi);
}

void scene_options(const imp_scene *scene, imp_options *options)
{
    const scene_settings *set = &scene->settings;
    *options = (imp_options){.struct_size = (uint32_t)sizeof *options,
                             .t_start = set->t_start,
                             .t_end = set->t_end,
                             .gamma = set->gamma,
                             .gamma_clear = set->gamma_clear,
                             .max_bytes = (uint64_t)1 << 30};
    double time[2];
    if (!isnan(set->t_start) || default_times(scene, time, NULL) != IMP_SUCCESS) return;
    options->t_start = time[0];
    options->t_end = time[1];
}

/* NAN twice stands for the scene's own times, which can be wrong. */
static imp_code check_times(const imp_scene *scene, const imp_options *options, imp_error *error)
{
    double time[2];
    return isnan(options->t_start) && isnan(options->t_end) ? default_times(scene, time, error)
                                                            : IMP_SUCCESS;
}

imp_code scene_check_options(const imp_scene *scene, const imp_options *options, imp_error *error)
{
    if (check_times(scene, options, error) != IMP_SUCCESS) return IMP_ERROR_SCENE;
    if (!(options->t_start <= options->t_end && options->t_start > -INFINITY &&
          options->t_end < INFINITY))
        return error_set(error, IMP_ERROR_USAGE, "time: got [%g, %g], must be finite and not empty",
                         options->t_start, options->t_end);
    if (!(options->max_seconds >= 0))
        return error_set(error, IMP_ERROR_USAGE, "max_seconds: got %g, must be >= 0",
                         options->max_seconds);
    return IMP_SUCCESS;
}

imp_code imp_options_get_default(const imp_scene *scene, imp_options *options, imp_error *error)
{
    if (scene == NULL) return error_set_missing(error, "imp_options_get_default");
    imp_options own;
    scene_options(scene, &own);
    const imp_code code = sized_check("imp_options", options, SCENE_OPTIONS_FIRST, error);
    if (code != IMP_SUCCESS) return code;
    sized_write(options, &own);
    return check_times(scene, &own, error);
}

/* --- Trees ------------------------------------------------------------------------------------ */

/* From this one on; NULL: there is none yet. */
static tree *find_tree(tree *t, const tree_plan *plan)
{
    while (t != NULL && !tree_is_of(t, plan)) t = tree_next(t);
    return t;
}

/* Adds the tree to the list, unless another thread has added one: then `made` is freed and that one
 * returned. */
static tree *keep_tree(member *m, const tree_plan *plan, tree *made)
{
    tree *first = atomic_load_explicit(&m->trees, memory_order_acquire);
    do {
        tree *found = find_tree(first, plan);
        if (found != NULL) {
            tree_free(made);
            return found;
        }
        tree_set_next(made, first);
    } while (!atomic_compare_exchange_weak_explicit(&m->trees, &first, made, memory_order_release,
                                                    memory_order_acquire));
    return made;
}

static const surface *find_inner(const inner *i, size_t left_out)
{
    while (i != NULL && i->left_out != left_out) i = i->next;
    return i != NULL ? i->surface : NULL;
}

/* Returns the surface without its last maps, made now if it is asked for first. NULL: no memory. */
static const surface *surface_in_frame(member *m, size_t left_out, tree_growth *growth)
{
    if (left_out == 0) return m->surface;
    inner *first = atomic_load_explicit(&m->inners, memory_order_acquire);
    const surface *found = find_inner(first, left_out);
    if (found != NULL) return found;
    inner *made = malloc(sizeof *made);
    if (made == NULL) return NULL;
    *made = (inner){NULL, surface_new_inner(m->surface, surface_map_count(m->surface) - left_out),
                    left_out};
    if (made->surface == NULL) {
        free(made);
        return NULL;
    }
    do {
        found = find_inner(first, left_out);
        if (found != NULL) {
            inner_free(made);
            return found;
        }
        made->next = first;
    } while (!atomic_compare_exchange_weak_explicit(&m->inners, &first, made, memory_order_release,
                                                    memory_order_acquire));
    growth->bytes += sizeof *made + surface_bytes(made->surface);
    return made->surface;
}

/* Threads may make trees of one surface at once; one of each plan is kept. */
imp_code scene_tree(imp_scene *scene, size_t body, size_t index, const tree_plan *plan,
                    bool with_root, tree **found, tree_growth *growth, imp_error *error)
{
    member *m = &scene->bodies[body].members[index];
    tree *made;
    tree_growth own = {.watch = growth->watch};
    *found = find_tree(atomic_load_explicit(&m->trees, memory_order_acquire), plan);
    if (*found != NULL) return IMP_SUCCESS;
    const surface *s = surface_in_frame(m, plan->left_out, growth);
    if (s == NULL) return error_set_memory(error);
    tree_plan stored = *plan;
    stored.store = scene->store;
    const imp_code code = with_root ? tree_new(s, &stored, &made, &own, error)
                                    : tree_new_without_root(s, &stored, &made, &own, error);
    growth->ended = own.ended;
    if (code != IMP_SUCCESS) return code;
    *found = keep_tree(m, plan, made);
    if (*found == made) growth->nodes += own.nodes, growth->bytes += own.bytes;
    return IMP_SUCCESS;
}
