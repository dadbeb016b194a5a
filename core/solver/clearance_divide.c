/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include <stdlib.h>

#include "core/base/status.h"

/* --- What is asked ---------------------------------------------------------------------------- */

enum { SLICES_MAX = 1000000 };

static imp_code check(const imp_clearance_options *asked, imp_error *error)
{
    if (!(asked->tolerance >= 1e-9 && asked->tolerance < 1))
        return error_set(error, IMP_ERROR_USAGE, "tolerance: got %g, must be from 1e-9 to below 1",
                         asked->tolerance);
    if (!(asked->required >= 0 && asked->required < INFINITY))
        return error_set(error, IMP_ERROR_USAGE,
                         "required: got %g, must be > 0 and finite, or 0 for none",
                         asked->required);
    if (asked->slices < 1 || asked->slices > SLICES_MAX)
        return error_set(error, IMP_ERROR_USAGE, "slices: got %llu, must be from 1 to %d",
                         (unsigned long long)asked->slices, SLICES_MAX);
    return IMP_SUCCESS;
}

static size_t body_pair_count(const clearance_search *c)
{
    if (!c->asked.each) return 1;
    const size_t n = imp_scene_body_count(c->scene);
    size_t count = 0;
    for (size_t a = 0; a < n; ++a)
        for (size_t b = a + 1; b < n; ++b) count += !scene_ignores(c->scene, a, b);
    return count;
}

/* The slices of one pair of bodies, from tasks[c->count] on. Neighbours share the moment
 * between. */
static void add_slices(clearance_search *c, size_t a, size_t b)
{
    const double n = (double)c->asked.slices;
    double start = c->options.t_start;
    for (uint64_t k = 1; k <= c->asked.slices; ++k) {
        const double share = (double)k / n;
        const double end = k == c->asked.slices
                               ? c->options.t_end
                               : (1 - share) * c->options.t_start + share * c->options.t_end;
        imp_clearance *answer = &c->tasks[c->count++].answer;
        *answer = (imp_clearance){.struct_size = (uint32_t)sizeof *answer,
                                  .t_start = start,
                                  .t_end = end,
                                  .body = {a, b},
                                  .required = c->asked.required,
                                  .upper = INFINITY,
                                  .t = NAN,
                                  .t_violated = NAN};
        start = end;
    }
}

static imp_code add_tasks(clearance_search *c, imp_error *error)
{
    const size_t n = imp_scene_body_count(c->scene);
    c->tasks = calloc(body_pair_count(c) * c->asked.slices + 1, sizeof *c->tasks);
    if (c->tasks == NULL) return error_set_memory(error);
    if (!c->asked.each) add_slices(c, SIZE_MAX, SIZE_MAX);
    for (size_t a = 0; c->asked.each && a < n; ++a)
        for (size_t b = a + 1; b < n; ++b)
            if (!scene_ignores(c->scene, a, b)) add_slices(c, a, b);
    return IMP_SUCCESS;
}

imp_code clearance_new(const imp_scene *scene, bool any_pair, const imp_options *options,
                       const imp_clearance_options *asked, clearance_search **made,
                       imp_error *error)
{
    if (check(asked, error) != IMP_SUCCESS) return IMP_ERROR_USAGE;
    if (options->baseline != IMP_BASELINE_NONE)
        return error_set(error, IMP_ERROR_USAGE,
                         "baseline: must be 0 where the minimum distance is asked for");
    clearance_search *c = calloc(1, sizeof *c);
    if (c == NULL) return error_set_memory(error);
    c->scene = scene;
    c->any_pair = any_pair;
    c->options = *options;
    c->asked = *asked;
    const imp_code code = add_tasks(c, error);
    if (code == IMP_SUCCESS)
        *made = c;
    else
        clearance_free(c);
    return code;
}

imp_code clearance_part(const clearance_search *whole, const size_t body[2],
                        clearance_search **made, imp_error *error)
{
    clearance_search *c = calloc(1, sizeof *c);
    if (c == NULL) return error_set_memory(error);
    *c = (clearance_search){.scene = whole->scene,
                            .any_pair = true,
                            .options = whole->options,
                            .asked = whole->asked,
                            .tasks = calloc(whole->asked.slices, sizeof *c->tasks)};
    if (c->tasks == NULL) {
        clearance_free(c);
        return error_set_memory(error);
    }
    add_slices(c, body[0], body[1]);
    *made = c;
    return IMP_SUCCESS;
}

bool clearance_is_each(const clearance_search *c) { return c->asked.each; }

bool clearance_is_of_all_times(const clearance_search *c) { return c->asked.slices == 1; }

void clearance_free(clearance_search *c)
{
    if (c == NULL) return;
    min_distance_clear(&c->distance);
    impact_clear(&c->violation);
    free(c->tasks);
    free(c);
}

static bool is_of(const candidate_pair *both, const size_t body[2])
{
    return both->side[0]->body == body[0] && both->side[1]->body == body[1];
}

/* The list is in the order of the scene, so that the candidates of two bodies stand together. */
static void find_candidates(const candidate_list *list, clearance_task *p)
{
    const size_t *body = p->answer.body;
    size_t first = 0, end = list->pair_count;
    if (body[0] != SIZE_MAX) {
        while (first < list->pair_count && !is_of(&list->pairs[first], body)) ++first;
        for (end = first; end < list->pair_count && is_of(&list->pairs[end], body);) ++end;
    }
    p->first = first;
    p->count = end - first;
}

void clearance_begin(clearance_search *c, const candidate_list *list, imp_stats *stats)
{
    c->list = list;
    c->stats = stats;
    for (size_t k = 0; k < c->count; ++k) {
        clearance_task *p = &c->tasks[k];
        if (k % c->asked.slices == 0) {
            find_candidates(list, p);
        } else {
            p->first = p[-1].first;
            p->count = p[-1].count;
        }
    }
}
