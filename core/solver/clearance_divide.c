/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include <stdlib.h>

#include "core/base/status.h"
#include "core/scene/tolerances.h"

/* --- Options and groups ----------------------------------------------------------------------- */

enum { SLICES_MAX = 1000000 };

static imp_code check(const imp_clearance_options *asked, imp_error *error)
{
    const imp_code code = tolerances_check_clearance(asked, error);
    if (code != IMP_SUCCESS) return code;
    if (asked->slices < 1 || asked->slices > SLICES_MAX)
        return error_set(error, IMP_ERROR_USAGE, "slices: got %llu, must be from 1 to %d",
                         (unsigned long long)asked->slices, SLICES_MAX);
    if (!(asked->within >= 0 && asked->within < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "within: got %g, must be > 0 and finite, or 0 for any distance",
                         asked->within);
    if (asked->within > 0 && asked->within < asked->required)
        return error_set(error, IMP_ERROR_USAGE,
                         "within: got %g, must be at least what is required, %g", asked->within,
                         asked->required);
    return IMP_SUCCESS;
}

static size_t body_pair_count(const imp_scene *scene)
{
    const size_t n = imp_scene_body_count(scene);
    size_t count = 0;
    for (size_t a = 0; a < n; ++a)
        for (size_t b = a + 1; b < n; ++b) count += !scene_ignores(scene, a, b);
    return count;
}

static void add_group(clearance_search *c, size_t a, size_t b)
{
    c->groups[c->group_count++] = (clearance_group){.body = {a, b}};
}

/* Whether groups can only be made once the candidates are known: those within asked.within. */
static bool awaits_candidates(const clearance_search *c)
{
    return c->asked.each && c->asked.within > 0;
}

static imp_code add_groups(clearance_search *c, imp_error *error)
{
    const size_t n = imp_scene_body_count(c->scene);
    if (awaits_candidates(c)) return IMP_SUCCESS;
    c->groups =
        arena_store_room(scene_store(c->scene),
                         (c->asked.each ? body_pair_count(c->scene) + 1 : 1) * sizeof *c->groups);
    if (c->groups == NULL) return error_set_memory(error);
    if (!c->asked.each) add_group(c, SIZE_MAX, SIZE_MAX);
    for (size_t a = 0; c->asked.each && a < n; ++a)
        for (size_t b = a + 1; b < n; ++b)
            if (!scene_ignores(c->scene, a, b)) add_group(c, a, b);
    return IMP_SUCCESS;
}

imp_code clearance_new(imp_scene *scene, bool any_pair, const imp_options *options,
                       const imp_clearance_options *asked, const limit_watch *watch,
                       clearance_search **made, imp_error *error)
{
    if (check(asked, error) != IMP_SUCCESS) return IMP_ERROR_USAGE;
    if (options->baseline != IMP_BASELINE_NONE)
        return error_set(error, IMP_ERROR_USAGE,
                         "baseline: must be 0 where the minimum distance is asked for");
    clearance_search *c = arena_store_zeroed(scene_store(scene), sizeof *c);
    if (c == NULL) return error_set_memory(error);
    c->scene = scene;
    c->any_pair = any_pair;
    c->options = *options;
    c->asked = *asked;
    c->watch = watch;
    const imp_code code = add_groups(c, error);
    if (code == IMP_SUCCESS)
        *made = c;
    else
        clearance_free(c);
    return code;
}

imp_code clearance_part(const clearance_search *whole, const size_t body[2],
                        const limit_watch *watch, clearance_search **made, imp_error *error)
{
    arena_store *store = scene_store(whole->scene);
    clearance_search *c = arena_store_room(store, sizeof *c);
    if (c == NULL) return error_set_memory(error);
    *c = (clearance_search){.scene = whole->scene,
                            .any_pair = true,
                            .options = whole->options,
                            .asked = whole->asked,
                            .watch = watch,
                            .groups = arena_store_room(store, sizeof *c->groups)};
    if (c->groups == NULL) {
        clearance_free(c);
        return error_set_memory(error);
    }
    add_group(c, body[0], body[1]);
    *made = c;
    return IMP_SUCCESS;
}

bool clearance_is_each(const clearance_search *c) { return c->asked.each; }

double clearance_near(const clearance_search *c)
{
    return c->asked.within > 0 ? c->asked.within : INFINITY;
}

/* Lemma. With a slip of R gamma / 4, 4 slip <= R upper wherever upper > gamma (min_distance.c). A
 * millionth of what is required (tolerances_nearly) leaves room for 8 slips of 2^-24 of it. */
double clearance_slip_most(const clearance_search *c)
{
    const double by_tolerance = 0.25 * c->asked.tolerance * c->options.gamma;
    const double by_required = 0x1p-24 * c->asked.required;
    return c->asked.required > 0 && by_required < by_tolerance ? by_required : by_tolerance;
}

bool clearance_is_of_all_times(const clearance_search *c) { return c->asked.slices == 1; }

void clearance_free(clearance_search *c)
{
    if (c == NULL) return;
    min_distance_clear(&c->distance);
    impact_clear(&c->violation);
    if (c->list != NULL) candidates_wake(c->list, &c->moments, c->stats);
    candidates_clear(&c->own);
    inside_free(c->insides);
    arena_store *store = scene_store(c->scene);
    arena_store_free_room(store, c->answers);
    arena_store_free_room(store, c->groups);
    arena_store_free_room(store, c);
}

/* --- Tasks ------------------------------------------------------------------------------------ */

size_t clearance_count(const clearance_search *c)
{
    return c->group_count * (size_t)c->asked.slices;
}

/* Returns when slice k begins; neighbours share the moment between them. */
static double slice_start(const clearance_search *c, uint64_t k)
{
    const double share = (double)k / (double)c->asked.slices;
    if (k == 0) return c->options.t_start;
    if (k == c->asked.slices) return c->options.t_end;
    return (1 - share) * c->options.t_start + share * c->options.t_end;
}

imp_clearance clearance_blank_answer(const clearance_search *c, size_t index)
{
    const clearance_group *group = &c->groups[index / c->asked.slices];
    const uint64_t k = index % c->asked.slices;
    return (imp_clearance){.struct_size = (uint32_t)sizeof(imp_clearance),
                           .t_start = slice_start(c, k),
                           .t_end = slice_start(c, k + 1),
                           .body = {group->body[0], group->body[1]},
                           .required = c->asked.required,
                           .upper = INFINITY,
                           .t = NAN,
                           .t_violated = NAN};
}

static bool is_of(const candidate_pair *both, const size_t body[2])
{
    return both->side[0]->body == body[0] && both->side[1]->body == body[1];
}

static imp_code add_candidate_groups(clearance_search *c, const candidate_list *list,
                                     imp_error *error)
{
    size_t count = 0;
    for (size_t k = 0; k < list->pair_count; ++k) count += candidate_pair_is_first(list->pairs, k);
    c->groups = arena_store_room(scene_store(c->scene), (count + 1) * sizeof *c->groups);
    if (c->groups == NULL) return error_set_memory(error);
    for (size_t k = 0; k < list->pair_count; ++k)
        if (candidate_pair_is_first(list->pairs, k))
            add_group(c, list->pairs[k].side[0]->body, list->pairs[k].side[1]->body);
    return IMP_SUCCESS;
}

/* The list and the groups are in the order of the scene: candidates of two bodies are
 * neighbours. */
imp_code clearance_begin(clearance_search *c, const candidate_list *list, imp_stats *stats,
                         imp_error *error)
{
    size_t next = 0;
    c->whole = c->list = list;
    c->stats = stats;
    c->shared_bytes = c->fresh_bytes = stats->bytes;
    if (c->groups == NULL && add_candidate_groups(c, list, error) != IMP_SUCCESS)
        return error->code;
    for (size_t k = 0; k < c->group_count; ++k) {
        clearance_group *group = &c->groups[k];
        const bool is_all = group->body[0] == SIZE_MAX;
        group->first = next;
        while (next < list->pair_count && (is_all || is_of(&list->pairs[next], group->body)))
            ++next;
        group->count = next - group->first;
    }
    return IMP_SUCCESS;
}
