/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/base/status.h"
#include "core/broad_phase/collection.h"

/* Pairs of a crowd, in the order in which they come near
 * ======================================================
 * The query's times are looked at in stretches, the first of 1/16 of them, each later one as long
 * as all before. All surfaces of pairs that wait get a box of the stretch; pairs of two bodies, of
 * which any have boxes that are near, are made ready. The search goes on with these up to the end
 * of the stretch.
 *
 * Lemma. A pair that still waits is farther apart than the stretches' distance, at all times up to
 * `until`: its two boxes, which hold all points of the surfaces in that stretch, were. That
 * distance is twice gamma, and no slip exceeds gamma - gamma_clear: so no such pair, in whatever
 * frame, has a point within gamma of another before `until`, and a search for the first contact
 * that takes it up then finds what it would have found with it from the start. */

/* --- The pairs of a small scene --------------------------------------------------------------- */

/* Makes the list's pairs of those found. */
static bool take_all(candidate_list *list)
{
    later_pairs *later = list->later;
    list->pairs = arena_store_room(list->store, (later->count + 1) * sizeof *list->pairs);
    if (list->pairs == NULL) return false;
    list->pair_capacity = later->count + 1;
    for (size_t k = 0; k < later->count; ++k)
        list->pairs[k] = (candidate_pair){
            .side = {&list->candidates[later->pair[k][0]], &list->candidates[later->pair[k][1]]}};
    list->pair_count = later->count;
    later_pairs_free(later);
    list->later = NULL;
    return true;
}

/* Stretches pay where there are more pairs than surfaces. */
imp_code collection_sort_later(collection *all, bool *done, imp_error *error)
{
    candidate_list *list = all->list;
    if (!later_pairs_sort(list->later, list->candidates, list->count))
        return *done = false, error_set_memory(error);
    list->later->spans = all->spans;
    if (list->later->count <= list->count && !take_all(list))
        return *done = false, error_set_memory(error);
    *done = !collection_must_end(all);
    return IMP_SUCCESS;
}

/* --- A stretch of time ------------------------------------------------------------------------ */

typedef struct stretch_box {
    double lo[3], hi[3];
    bool is_wanted, is_made;
} stretch_box;

typedef struct stretch {
    collection *all;            /* of the pairs that are made ready */
    const candidate_list *list; /* the query's */
    double from, to, distance;
    stretch_box *boxes;     /* of the list's candidates */
    unsigned char *is_near; /* of the pairs that wait */
    size_t near_count;
} stretch;

static void want_boxes(stretch *s)
{
    const later_pairs *later = s->list->later;
    for (size_t k = 0; k < s->list->count; ++k) s->boxes[k].is_wanted = s->boxes[k].is_made = false;
    for (size_t k = 0; k < later->count; ++k)
        for (int side = 0; side < 2; ++side) s->boxes[later->pair[k][side]].is_wanted = true;
}

/* A surface that does not exist then is infinitely far away. */
static imp_code make_box(stretch *s, size_t k, imp_error *error)
{
    stretch_box *box = &s->boxes[k];
    bool exists;
    if (!box->is_wanted || box->is_made) return IMP_SUCCESS;
    const imp_code code = tree_box_within(s->list->candidates[k].tree, s->from, s->to, &exists,
                                          box->lo, box->hi, error);
    for (int i = 0; i < 3 && code == IMP_SUCCESS && !exists; ++i)
        box->lo[i] = INFINITY, box->hi[i] = -INFINITY;
    box->is_made = code == IMP_SUCCESS;
    return code;
}

/* Makes boxes ahead of their turn. One that fails is made again in its turn. */
static void make_some(void *of, size_t task)
{
    stretch *s = of;
    const size_t first = task * SURFACES_A_TASK;
    if (collection_may_end(s->all, 0)) return;
    for (size_t k = first; k < s->list->count && k < first + SURFACES_A_TASK; ++k)
        make_box(s, k, NULL);
}

static imp_code make_boxes(stretch *s, bool *done, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    want_boxes(s);
    if (parallel_is_on(s->all->options))
        parallel_run(s->all->options, make_some, s,
                     (s->list->count + SURFACES_A_TASK - 1) / SURFACES_A_TASK);
    for (size_t k = 0; k < s->list->count && *done && code == IMP_SUCCESS; ++k) {
        *done = k % SURFACES_PER_CHECK != 0 || !collection_must_end(s->all);
        if (*done) code = make_box(s, k, error);
    }
    return code;
}

static bool is_near(const stretch *s, const uint32_t pair[2])
{
    const stretch_box *a = &s->boxes[pair[0]], *b = &s->boxes[pair[1]];
    return !broad_phase_apart(a->lo, a->hi, b->lo, b->hi, s->distance);
}

/* Marks all pairs of two bodies if one of them is near. Where more than half are, all are marked:
 * shorter stretches tell them apart no better. */
static void mark_near(stretch *s)
{
    const later_pairs *later = s->list->later;
    for (size_t k = 0, next; k < later->count; k = next) {
        next = later_pairs_next(later, s->list->candidates, k);
        bool any = false;
        for (size_t j = k; j < next && !any; ++j) any = is_near(s, later->pair[j]);
        memset(s->is_near + k, any, next - k);
        s->near_count += any ? next - k : 0;
    }
    if (s->near_count <= later->count / 2) return;
    memset(s->is_near, true, later->count);
    s->near_count = later->count;
}

static imp_code look(stretch *s, bool *done, imp_error *error)
{
    const candidate_list *list = s->list;
    s->boxes = arena_store_room(list->store, (list->count + 1) * sizeof *s->boxes);
    s->is_near = arena_store_room(list->store, list->later->count + 1);
    if (s->boxes == NULL || s->is_near == NULL) return error_set_memory(error);
    const imp_code code = make_boxes(s, done, error);
    if (code == IMP_SUCCESS && *done) mark_near(s);
    return code;
}

/* --- Making pairs ready ----------------------------------------------------------------------- */

/* Fills the list of the stretch with the near pairs, and with candidates of its own, in order.
 * `number` has room for one of each of the query's candidates. */
static void copy_near(const stretch *s, uint32_t *number)
{
    const later_pairs *later = s->list->later;
    candidate_list *to = s->all->list;
    memset(number, 0, s->list->count * sizeof *number);
    for (size_t k = 0; k < later->count; ++k)
        for (int side = 0; side < 2 && s->is_near[k]; ++side) number[later->pair[k][side]] = 1;
    for (size_t k = 0; k < s->list->count; ++k) {
        if (number[k] == 0) continue;
        number[k] = (uint32_t)to->count;
        to->candidates[to->count++] = s->list->candidates[k];
    }
    for (size_t k = 0; k < later->count; ++k)
        if (s->is_near[k])
            to->pairs[to->pair_count++] =
                (candidate_pair){.side = {&to->candidates[number[later->pair[k][0]]],
                                          &to->candidates[number[later->pair[k][1]]]}};
}

static bool take_near(const stretch *s)
{
    candidate_list *to = s->all->list;
    arena_store *store = s->list->store;
    const size_t most = 2 * s->near_count < s->list->count ? 2 * s->near_count : s->list->count;
    uint32_t *number = arena_store_room(store, (s->list->count + 1) * sizeof *number);
    to->candidates = arena_store_room(store, (most + 1) * sizeof *to->candidates);
    to->pairs = arena_store_room(store, (s->near_count + 1) * sizeof *to->pairs);
    to->pair_capacity = s->near_count + 1;
    const bool ok = number != NULL && to->candidates != NULL && to->pairs != NULL;
    if (ok) copy_near(s, number);
    arena_store_free_room(store, number);
    return ok;
}

static imp_code make_ready(const stretch *s, bool *done, imp_error *error)
{
    if (s->near_count == 0) return IMP_SUCCESS;
    if (!take_near(s)) return error_set_memory(error);
    *done = !collection_must_end(s->all);
    imp_code code = *done ? collection_use_frames(s->all, done, error) : IMP_SUCCESS;
    if (*done && code == IMP_SUCCESS) code = collection_make_roots(s->all, done, error);
    if (s->all->tree_ended && collection_must_end(s->all)) code = IMP_SUCCESS, *done = false;
    return code;
}

/* Makes room for `more` pairs. False: no memory. */
static bool reserve(candidate_list *list, size_t more)
{
    const size_t size = sizeof *list->pairs, capacity = list->pair_count + more + 1;
    if (capacity <= list->pair_capacity) return true;
    candidate_pair *grown =
        arena_store_regrow(list->store, list->pairs, list->pair_count * size, capacity * size);
    if (grown == NULL) return false;
    list->pairs = grown;
    list->pair_capacity = capacity;
    return true;
}

/* Leaves only the pairs that are not near. */
static void keep_rest(const stretch *s, later_pairs *later)
{
    size_t kept = 0;
    for (size_t k = 0; k < later->count; ++k)
        if (!s->is_near[k]) memmove(later->pair[kept++], later->pair[k], sizeof *later->pair);
    later->count = kept;
    later->until = kept > 0 ? s->to : INFINITY;
    later->spans = s->all->spans;
}

/* Adds the pairs of the stretch to the list. False: no memory, and nothing has changed. */
static bool add_ready(candidate_list *list, candidate_list *made)
{
    later_pairs *later = list->later;
    if (made->pair_count == 0) return true;
    ready_candidates *ready = arena_store_room(list->store, sizeof *ready);
    if (ready == NULL) return false;
    if (!reserve(list, made->pair_count)) return arena_store_free_room(list->store, ready), false;
    *ready = (ready_candidates){later->ready, made->candidates, made->count};
    later->ready = ready;
    later->ready_count += made->count;
    memcpy(list->pairs + list->pair_count, made->pairs, made->pair_count * sizeof *made->pairs);
    list->pair_count += made->pair_count;
    list->half_planes += made->half_planes;
    if (made->slip > list->slip) list->slip = made->slip;
    arena_store_free_room(list->store, made->pairs);
    *made = (candidate_list){.store = list->store};
    return true;
}

/* Ends of stretches: these parts of all times. */
static const double ends[] = {1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2};

static double end_after(const imp_options *options, double from, double until)
{
    double to = options->t_end;
    for (size_t k = sizeof ends / sizeof *ends; k-- > 0;) {
        const double end = options->t_start + ends[k] * (options->t_end - options->t_start);
        if (end > from && end < to) to = end;
    }
    return until < to ? until : to;
}

imp_code candidates_more(candidate_list *list, imp_scene *scene, const imp_options *options,
                         const candidate_search *search, const candidate_limit *limit, double until,
                         imp_stats *stats, bool *done, imp_error *error)
{
    later_pairs *later = list->later;
    candidate_list made = {.store = list->store};
    collection all = {.scene = scene,
                      .options = options,
                      .limit = limit,
                      .stats = stats,
                      .list = &made,
                      .gamma_clear = search->gamma_clear,
                      .slip_most = collection_slip_most(options, search),
                      .slip_useful = search->slip_useful,
                      .may_halve = search->may_halve,
                      .spans = later->spans,
                      .any_lacks_root = true};
    stretch s = {.all = &all,
                 .list = list,
                 .from = later->until,
                 .to = end_after(options, later->until, until),
                 .distance = 2 * options->gamma};
    *done = true;
    imp_code code = look(&s, done, error);
    if (code == IMP_SUCCESS && *done) code = make_ready(&s, done, error);
    if (code == IMP_SUCCESS && *done) {
        if (add_ready(list, &made))
            keep_rest(&s, later);
        else
            code = error_set_memory(error);
    }
    *done = *done && code == IMP_SUCCESS;
    if (s.to >= options->t_end && *done) later->count = 0, later->until = INFINITY;
    candidates_clear(&made);
    arena_store_free_room(list->store, s.boxes);
    arena_store_free_room(list->store, s.is_near);
    return code;
}

size_t candidates_pairs_in_all(const candidate_list *list)
{
    return list->pair_count + (list->later != NULL ? list->later->count : 0);
}

double candidates_apart_until(const candidate_list *list)
{
    return list->later != NULL ? list->later->until : INFINITY;
}
