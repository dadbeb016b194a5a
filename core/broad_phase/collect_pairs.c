/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/status.h"
#include "core/broad_phase/collection.h"
#include "core/common/array.h"

/* --- Pairs ------------------------------------------------------------------------------------ */

/* Makes the candidate pair of two surfaces, the body of smaller index first. False: they are not
 * tested: one body, or bodies that ignore each other. */
static bool make_pair(const collection *all, size_t first, size_t second, candidate_pair *p)
{
    candidate *candidates = all->list->candidates;
    const size_t a = first < second ? first : second, b = first < second ? second : first;
    *p = (candidate_pair){.side = {&candidates[a], &candidates[b]}};
    return candidates[a].body != candidates[b].body &&
           !scene_ignores(all->scene, candidates[a].body, candidates[b].body);
}

/* Appends the pair to the list. False: no memory. */
static bool keep_pair(collection *all, const candidate_pair *p)
{
    candidate_list *list = all->list;
    candidate_pair *grown = NULL;
    if (list->later != NULL) {
        all->out_of_memory = !later_pairs_add(list->later, (size_t)(p->side[0] - list->candidates),
                                              (size_t)(p->side[1] - list->candidates));
        return !all->out_of_memory;
    }
    if (list->pair_count < UINT32_MAX)
        grown = arena_store_reserve(list->store, list->pairs, list->pair_count,
                                    &list->pair_capacity, sizeof *grown);
    all->out_of_memory = grown == NULL;
    if (grown == NULL) return false;
    list->pairs = grown;
    list->pairs[list->pair_count++] = *p;
    return true;
}

static bool add_pair(void *context, size_t first, size_t second)
{
    collection *all = context;
    candidate_pair p;
    return !make_pair(all, first, second, &p) || keep_pair(all, &p);
}

/* Visits the pairs of box k with the sorted boxes after it. */
static bool visit_box(const collection *all, size_t k, const broad_phase_visitor *visitor)
{
    return strips_visit_box(&all->strips, all->boxes, all->list->count, all->axis, k,
                            all->gamma_clear, visitor);
}

/* --- Pairs found ahead ------------------------------------------------------------------------ */

typedef struct sweep_task {
    collection *all;
    sweep_ahead *to;
} sweep_task;

static bool add_pair_ahead(void *context, size_t first, size_t second)
{
    const sweep_task *task = context;
    sweep_ahead *to = task->to;
    candidate_pair p;
    if (!make_pair(task->all, first, second, &p)) return true;
    candidate_pair *grown = array_reserve(to->pairs, to->count, &to->capacity, sizeof *grown);
    if (grown == NULL) return false;
    to->pairs = grown;
    to->pairs[to->count++] = p;
    return true;
}

static void sweep_boxes(void *of, size_t index)
{
    collection *all = of;
    sweep_task task = {all, &all->sweep[index]};
    const broad_phase_visitor visitor = {NULL, add_pair_ahead, &task};
    const size_t first = all->first_box + index * BOXES_A_TASK, count = all->list->count;
    for (size_t k = first; k < count && k < first + BOXES_A_TASK; ++k) {
        const size_t before = task.to->count;
        if (collection_may_end(all, sizeof(candidate_pair))) return;
        if (!visit_box(all, k, &visitor)) return;
        atomic_fetch_add(&all->bytes_ahead, (task.to->count - before) * sizeof(candidate_pair));
    }
    task.to->complete = true;
}

/* Adds the pairs of one task's boxes: those found ahead if all were found, else finds them now.
 * False: a limit, or no memory. */
static bool take_boxes(collection *all, const sweep_ahead *found, size_t first)
{
    const broad_phase_visitor visitor = {NULL, add_pair, all};
    const size_t count = all->list->count;
    bool go_on = !collection_must_end(all);
    for (size_t k = 0; go_on && found->complete && k < found->count; ++k)
        go_on = keep_pair(all, &found->pairs[k]);
    for (size_t k = first; go_on && !found->complete && k < count && k < first + BOXES_A_TASK; ++k)
        go_on = !collection_must_end(all) && visit_box(all, k, &visitor);
    return go_on;
}

/* Adds the pairs of one round, and frees those found ahead. False: a limit, or no memory. */
static bool take_round(collection *all)
{
    bool go_on = true;
    for (size_t k = 0; k < TASKS_A_ROUND; ++k) {
        const size_t first = all->first_box + k * BOXES_A_TASK;
        go_on = go_on && (first >= all->list->count || take_boxes(all, &all->sweep[k], first));
        free(all->sweep[k].pairs);
        all->sweep[k] = (sweep_ahead){0};
    }
    return go_on;
}

static bool sweep_by_threads(collection *all)
{
    const size_t count = all->list->count, round = TASKS_A_ROUND * BOXES_A_TASK;
    bool go_on = true;
    for (all->first_box = 0; go_on && all->first_box < count; all->first_box += round) {
        const size_t rest = count - all->first_box, boxes = rest < round ? rest : round;
        atomic_store(&all->bytes_ahead, 0);
        parallel_run(all->options, sweep_boxes, all, (boxes + BOXES_A_TASK - 1) / BOXES_A_TASK);
        go_on = take_round(all);
    }
    return go_on;
}

static bool go_on(void *context)
{
    collection *all = context;
    const bool many = all->boxes_swept++ % BOXES_PER_CHECK == 0;
    if (!many && !all->limit->is_near(all->limit->context, candidates_bytes(all->list), 0))
        return true;
    return !collection_must_end(all);
}

static bool sweep_alone(collection *all)
{
    const broad_phase_visitor visitor = {NULL, add_pair, all};
    for (size_t k = 0; k < all->list->count; ++k)
        if (!go_on(all) || !visit_box(all, k, &visitor)) return false;
    return true;
}

static bool sweep(collection *all)
{
    const size_t count = all->list->count;
    all->axis = broad_phase_sort(all->boxes, count);
    all->out_of_memory = !strips_make(&all->strips, all->boxes, count, all->axis, all->gamma_clear,
                                      all->list->store);
    const bool done =
        !all->out_of_memory && (all->sweep != NULL ? sweep_by_threads(all) : sweep_alone(all));
    strips_clear(&all->strips);
    return done;
}

bool collection_add_pairs(collection *all)
{
    const broad_phase_visitor visitor = {NULL, add_pair, all};
    const size_t count = all->list->count;
    const bool done = count <= BROAD_PHASE_FEW
                          ? broad_phase_visit_all(all->boxes, count, all->gamma_clear, &visitor)
                          : sweep(all);
    return done && !collection_must_end(all); /* counts the bytes of the last pairs */
}

/* --- The nearest pair ------------------------------------------------------------------------- */

static bool exists_always(const collection *all, const candidate *c)
{
    double lo[3], hi[3];
    surface_domain(scene_surface(all->scene, c->body, c->surface), lo, hi);
    return lo[2] <= all->options->t_start && hi[2] >= all->options->t_end;
}

static bool are_met(void *context, size_t first, size_t second)
{
    const collection *all = context;
    candidate_pair p;
    return make_pair(all, first, second, &p) && exists_always(all, p.side[0]) &&
           exists_always(all, p.side[1]);
}

/* Lemma. Some pair is within `least` at every time, so that a pair farther than that is at no time
 * the nearest, nor the first that comes nearer than what is required: if that is more than `least`,
 * the former pair is nearer from the start. The factor outweighs the rounding of motions that all
 * trees leave out. */
void collection_limit_distance(collection *all)
{
    const broad_phase_visitor visitor = {go_on, are_met, all};
    const int axis = broad_phase_sort(all->boxes, all->list->count);
    double least = broad_phase_least_distance(all->boxes, all->list->count, axis, &visitor);
    least *= 1 + 0x1p-20;
    if (least < all->gamma_clear) all->gamma_clear = least;
}

/* --- Pairs of solid bodies -------------------------------------------------------------------- */

/* The first candidate of a body, and a box around all of them. */
typedef struct body_box {
    size_t first;
    double lo[3], hi[3];
} body_box;

static void box_bodies(const collection *all, body_box *box)
{
    for (size_t b = 0; b < scene_body_count(all->scene); ++b)
        box[b] =
            (body_box){SIZE_MAX, {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (size_t k = 0; k < all->list->count; ++k) {
        const candidate *c = &all->list->candidates[k];
        body_box *of = &box[c->body];
        double lo[3], hi[3];
        tree_box(c->tree, lo, hi);
        if (of->first == SIZE_MAX) of->first = k;
        for (int i = 0; i < 3; ++i) {
            if (!(lo[i] >= of->lo[i])) of->lo[i] = lo[i];
            if (!(hi[i] <= of->hi[i])) of->hi[i] = hi[i];
        }
    }
}

static bool boxes_meet(const body_box *a, const body_box *b)
{
    for (int i = 0; i < 3; ++i)
        if (a->lo[i] > b->hi[i] || b->lo[i] > a->hi[i]) return false;
    return true;
}

/* Marks the bodies that have a pair with `body` among the first pairs. */
static void mark_partners(const candidate_list *list, size_t body, bool *has_pair)
{
    for (size_t k = 0; k < list->pair_count; ++k) {
        const candidate_pair *p = &list->pairs[k];
        if (p->side[0]->body == body) has_pair[p->side[1]->body] = true;
        if (p->side[1]->body == body) has_pair[p->side[0]->body] = true;
    }
}

static void pair_solid(collection *all, size_t body, const body_box *box, bool *has_pair)
{
    const size_t bodies = scene_body_count(all->scene);
    candidate_pair p;
    for (size_t b = 0; b < bodies; ++b) has_pair[b] = b == body;
    mark_partners(all->list, body, has_pair);
    for (size_t b = 0; b < bodies && !all->out_of_memory; ++b)
        if (!has_pair[b] && box[b].first != SIZE_MAX && boxes_meet(&box[body], &box[b]) &&
            make_pair(all, box[body].first, box[b].first, &p))
            keep_pair(all, &p);
}

imp_code collection_add_solids(collection *all, bool *done, imp_error *error)
{
    const size_t bodies = scene_body_count(all->scene);
    body_box *box = malloc(bodies * sizeof *box);
    bool *has_pair = malloc(bodies * sizeof *has_pair);
    all->out_of_memory = box == NULL || has_pair == NULL;
    if (!all->out_of_memory) box_bodies(all, box);
    for (size_t b = 0; *done && b < bodies && !all->out_of_memory; ++b) {
        if (!scene_is_solid(all->scene, b) || box[b].first == SIZE_MAX) continue;
        pair_solid(all, b, box, has_pair);
        *done = !collection_must_end(all);
    }
    free(box);
    free(has_pair);
    return all->out_of_memory ? error_set_memory(error) : IMP_SUCCESS;
}
