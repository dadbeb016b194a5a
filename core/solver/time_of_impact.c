/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/time_of_impact.h"

#include <assert.h>

#include "core/bounds/strategy.h"
#include "core/solver/contradiction.h"
#include "core/solver/expand_pair.h"
#include "core/solver/pair_meeting.h"
#include "core/solver/pair_note.h"
#include "core/solver/pair_step.h"

/* Reserve heap space for half of the remaining candidate pairs, but at most this many: most are
 * pushed. */
enum { ROOM_MOST = 512 };

static bool reserve_for_candidate(impact *im, uint32_t index)
{
    const size_t count = im->candidate_pair_count, half = count > index ? (count - index) / 2 : 0;
    if (im->heap.count < im->heap.capacity) return true;
    return pair_heap_reserve(&im->heap, 1 + (half < ROOM_MOST ? half : ROOM_MOST));
}

/* Allocates the counts of an explanation, where one is asked for. False: no memory. */
static bool reserve_explained(impact *im)
{
    const size_t count = im->candidate_pair_count;
    if (!im->explains || im->explained != NULL || count == 0) return true;
    im->explained = arena_store_zeroed(im->heap.store, count * sizeof *im->explained);
    if (im->explained != NULL) im->stats->bytes += count * sizeof *im->explained;
    return im->explained != NULL;
}

imp_code impact_add_candidate(impact *im, uint32_t index, impact_state *state, imp_error *error)
{
    pair_test t;
    *state = IMPACT_NO_MEMORY;
    if (!reserve_explained(im)) return IMP_SUCCESS;
    const imp_code code = pair_test_candidate(im, index, &t, error);
    if (code == IMP_ERROR_MEMORY) return IMP_SUCCESS;
    if (code == IMP_SUCCESS && t.any_time && t.near && !reserve_for_candidate(im, index))
        return IMP_SUCCESS;
    *state = IMPACT_RUNNING;
    if (code != IMP_SUCCESS || !t.any_time) return code;
    impact_push(im, &t);
    return pair_meeting_try(im, &t, error);
}

/* --- Refining --------------------------------------------------------------------------------- */

/* Tests the roots of both surfaces and returns the window that is left; it counts as one pair. */
static time_window window_of_roots(impact *im, uint32_t index)
{
    const candidate_pair *both = &im->candidate_pairs[index];
    pair p = {.a = tree_root(both->side[0]->tree), .b = tree_root(both->side[1]->tree)};
    p.window = window_common(im->window, pair_times(p.a, p.b));
    im->stats->pairs += 1;
    return pair_test_fully(im, &p) ? p.window : (time_window){INFINITY, -INFINITY};
}

/* Lemma. Everything pruned so far is farther apart than the old gamma_clear, and windows were cut
 * by it; for a smaller one both still hold, so the heap and t_lower carry over. */
bool impact_refine(impact *im, double gamma, double gamma_clear, size_t count)
{
    if (im->roots == NULL && count > 0) {
        im->roots = arena_store_room(im->heap.store, count * sizeof *im->roots);
        if (im->roots == NULL) return false;
        for (size_t k = 0; k < count; ++k) im->roots[k] = (time_window){NAN, NAN};
    }
    for (size_t k = 0; k < count; ++k)
        if (im->roots[k].lo > -INFINITY) im->roots[k] = (time_window){NAN, NAN};
    im->ahead.count = 0; /* their tests used the old gamma_clear */
    im->gamma = gamma;
    im->gamma_clear = gamma_clear;
    upper_time_refine(&im->upper, gamma);
    im->refined = im->serial;
    return true;
}

/* Returns a window of the roots, which starts no later than the pair's; unbounded if not known. */
static const time_window *roots_of(impact *im, const pair *p)
{
    time_window *whole = &im->roots[p->candidate_pair];
    if (!isnan(whole->lo)) return whole;
    *whole = window_of_roots(im, p->candidate_pair);
    if (whole->lo <= p->window.lo) *whole = (time_window){-INFINITY, INFINITY};
    return whole;
}

/* After refining, cuts the popped pair by the new gamma_clear. False: it is pruned, or was pushed
 * again with a later start, and the step is over. The window of the roots bounds those of all
 * descendants; without it, descendants that were cut to an earlier start would each have to be
 * tested up to the contact, and along a curve of contacts all of them before any witness counts. (A
 * sphere that meets a torus took 1467 pairs from 1e-2 to 1e-9, now 118; a new query takes 110.) If
 * the roots' window does not help, the pair itself is tested again, once. */
static bool recut_after_refining(impact *im, pair *p)
{
    if (im->roots == NULL || im->baseline != IMP_BASELINE_NONE) return true;
    const time_window *whole = roots_of(im, p);
    p->window = window_common(p->window, *whole);
    if (p->window.lo > p->window.hi) return false;
    if (p->serial < im->refined && !(whole->lo > -INFINITY) &&
        !pairs_are_spent(im->stats, im->max_pairs)) {
        im->stats->pairs += 1;
        if (!pair_test_fully(im, p)) return false;
        p->serial = im->serial++;
    }
    if (p->window.lo == p->key[0]) return true;
    p->key[0] = p->window.lo;
    pair_heap_push(&im->heap, p);
    return false;
}

/* Requests the nets of a popped pair whose first test did without; on failure the pair goes back on
 * the heap. */
static imp_code request_nets(impact *im, pair *p, imp_error *error)
{
    if (!p->lacks_nets) return IMP_SUCCESS;
    const imp_code code = pair_test_ask_for_nets(im, p, &im->stats->bytes, error);
    p->lacks_nets = code != IMP_SUCCESS;
    if (code != IMP_SUCCESS) pair_heap_push(&im->heap, p);
    return code;
}

/* Whether a pair that starts then is the first of all, with those that are no candidates yet. */
static bool is_first(const impact *im, double start)
{
    return start < im->apart_until &&
           (im->heap.count == 0 || !(start > pair_heap_first(&im->heap)));
}

/* Completes the test of a popped pair that had only its first test. False: it is pruned, or was
 * pushed again with a later start, and the step is over. */
static bool complete_test(impact *im, pair *p)
{
    if (!p->is_seen_only) return true;
    const bool near = pair_test_fully(im, p);
    pair_note_test(im->proof, p, near);
    if (!near) return false;
    if (is_first(im, p->window.lo) && !(im->upper.is_known && p->window.lo >= im->upper.t)) {
        if (p->window.lo > im->t_lower) im->t_lower = p->window.lo;
        p->key[0] = p->window.lo;
        return true;
    }
    p->key[0] = p->window.lo;
    p->key[1] = pair_order(p, p->window.lo);
    pair_heap_push(&im->heap, p);
    return false;
}

bool impact_pass(impact *im)
{
    const size_t count = im->candidate_pair_count;
    if (im->passed == NULL)
        im->passed = arena_store_zeroed(im->heap.store, count * sizeof *im->passed);
    if (im->passed == NULL) return false;
    const candidate_pair *found = &im->candidate_pairs[im->found_candidate];
    for (size_t k = 0; k < count; ++k) {
        const candidate_pair *both = &im->candidate_pairs[k];
        if (candidate_pairs_same_bodies(both, found)) im->passed[k] = true;
    }
    if (im->passed[im->upper.candidate_pair]) im->upper.is_known = im->upper.has_horizon = false;
    return true;
}

/* --- An upper time ---------------------------------------------------------------------------- */

/* Whether no pair on the heap starts before the known contact. */
static bool is_settled(const impact *im)
{
    return im->upper.is_known &&
           (im->heap.count == 0 || !(pair_heap_first(&im->heap) < im->upper.t));
}

bool impact_lacks_candidates(const impact *im)
{
    const double until = im->apart_until;
    if (!(until < INFINITY) || (im->upper.is_known && im->upper.t <= until && is_settled(im)))
        return false;
    return im->heap.count == 0 || !(pair_heap_first(&im->heap) < until);
}

/* Ends the search with the known contact. */
static impact_state settle(impact *im)
{
    im->t_lower = im->upper.t;
    im->found_candidate = im->upper.candidate_pair;
    return impact_contact(im, &im->upper.seen);
}

/* Sets the error for a contact at a time before which contacts were excluded. */
static imp_code contradict(const impact *im, imp_error *error)
{
    const candidate_pair *both = &im->candidate_pairs[im->found_candidate];
    return contradiction_fault(tree_surface(both->side[0]->tree), tree_surface(both->side[1]->tree),
                               im->found.gap_upper, im->t_lower, im->gamma_clear, error);
}

/* A pair that waited until a later time, where it was taken to be apart before, meets earlier. */
static imp_code contradict_before(impact *im, double t, imp_error *error)
{
    im->t_lower = t;
    return im->found.gap_upper < im->gamma_clear ? contradict(im, error) : IMP_SUCCESS;
}

/* Ends the pair's window at the horizon, which is inside it, and pushes the later part.
 * Precondition: the heap has capacity. */
static void push_later(impact *im, pair *p)
{
    pair later = *p;
    later.window.lo = p->window.hi = im->upper.horizon;
    later.serial = im->serial++;
    later.key[0] = later.window.lo;
    const uint32_t whole = p->proof;
    pair_note_span(im->proof, p);
    later.proof = whole;
    pair_note_span(im->proof, &later);
    pair_heap_push(&im->heap, &later);
}

static inline void postpone(impact *im, pair *p)
{
    if (upper_time_divides(&im->upper, &p->window)) push_later(im, p);
}

/* Counts the pair, seeks an upper time from it at intervals, and ends its window at the horizon. */
static imp_code seek_upper_time(impact *im, pair *p, imp_error *error)
{
    bool sought;
    if (im->baseline != IMP_BASELINE_NONE || im->spread != NULL) return IMP_SUCCESS;
    const imp_code code = upper_time_follow(&im->upper, p, im->gamma, &sought, error);
    im->stats->witness_searches += sought;
    if (im->upper.is_known) impact_note_gap(im, &im->upper.seen);
    postpone(im, p);
    return code;
}

/* Whether a paraboloid separates the pair in this window, which ends at the known contact: that of
 * the contact, or the plane across the pair's own axis. */
static bool is_separated(const impact *im, const pair *p, const time_window *until)
{
    const upper_time *up = &im->upper;
    const net_paraboloid own = {.normal = vec3_scale(p->axis, 1 / vec3_norm(p->axis)),
                                .time = up->t};
    if (up->candidate_pair == p->candidate_pair &&
        net_paraboloid_parts(p->a, p->b, &up->paraboloid, im->gamma_clear, until))
        return true;
    return net_paraboloid_parts(p->a, p->b, &own, im->gamma_clear, until);
}

/* Separates the pair up to the known contact by a paraboloid (net_paraboloid.h), if that succeeds:
 * the rest of the window goes back on the heap. Not where a proof is kept: its verifier knows no
 * paraboloids. Precondition: the heap has capacity. */
static bool part_by_paraboloid(impact *im, pair *p)
{
    const upper_time *up = &im->upper;
    if (!up->is_known || !up->has_horizon || im->proof != NULL) return false;
    const time_window until = window_common(p->window, (time_window){p->window.lo, up->t});
    if (p->divided == up->count || !(until.lo < until.hi)) return false;
    if (!strategy_has_both_hulls(p->a, p->b)) return false;
    p->divided = up->count;
    if (!is_separated(im, p, &until)) return false;
    if (!(p->window.hi > up->t)) return true;
    p->window.lo = p->key[0] = up->t;
    p->key[1] = pair_order(p, up->t);
    pair_heap_push(&im->heap, p);
    return true;
}

/* --- One step --------------------------------------------------------------------------------- */

/* Allocates the counts of trials (pair_trials). False: no memory. */
static bool reserve_trials(impact *im)
{
    const size_t count = im->baseline == IMP_BASELINE_NONE ? im->candidate_pair_count : 0;
    if (im->trials != NULL || count == 0) return true;
    im->trials = arena_store_zeroed(im->heap.store, count * sizeof *im->trials);
    if (im->trials != NULL) im->stats->bytes += count * sizeof *im->trials;
    return im->trials != NULL;
}

/* Most pairs that one step pushes, less the slot that its pop frees: two later parts of windows,
 * and two halves, or one half and the popped pair again. */
enum { ROOM_OF_STEP = 3 };

/* Lemma. The popped pair's window starts first of all, and outside the windows on the heap no two
 * points are within gamma_clear, but those of later candidate pairs, which are apart until then:
 * so no two are before that start. Children's windows lie in their parent's, so the bound never
 * falls. A pair that ends the search is pushed again, so that a smaller gamma can continue from
 * it. A known contact no later than the first window is the answer; it is no earlier than t_lower,
 * since its search began at a window's start, and windows are popped in order. */
imp_code impact_advance(impact *im, impact_state *state, imp_error *error)
{
    const double proved = im->t_lower;
    *state = is_settled(im) ? settle(im) : IMPACT_CLEAR;
    if (*state == IMPACT_CONTACT && im->t_lower < proved && im->found.gap_upper < im->gamma_clear)
        return contradict(im, error);
    if (*state == IMPACT_CONTACT || im->heap.count == 0) return IMP_SUCCESS;
    *state = IMPACT_NO_MEMORY;
    if (!pair_heap_reserve(&im->heap, ROOM_OF_STEP) || !reserve_trials(im)) return IMP_SUCCESS;
    *state = IMPACT_RUNNING;
    pair p = pair_heap_pop(&im->heap);
    if (im->passed != NULL && im->passed[p.candidate_pair]) return IMP_SUCCESS;
    if (p.window.lo > im->t_lower) im->t_lower = p.window.lo;
    imp_code code = request_nets(im, &p, error);
    if (code != IMP_SUCCESS) return code;
    if (!recut_after_refining(im, &p)) return IMP_SUCCESS;
    postpone(im, &p);
    if (!complete_test(im, &p)) return IMP_SUCCESS;
    code = seek_upper_time(im, &p, error);
    if (code == IMP_SUCCESS && part_by_paraboloid(im, &p)) return IMP_SUCCESS;
    pair expanded = p; /* p itself is pushed again if the search ends here */
    if (code == IMP_SUCCESS) code = expand_pair(im, &expanded, state, error);
    if (code != IMP_SUCCESS || *state != IMPACT_RUNNING) pair_heap_push(&im->heap, &p);
    im->found_candidate = p.candidate_pair;
    if (code == IMP_SUCCESS && *state == IMPACT_CONTACT && p.window.lo < im->t_lower)
        return contradict_before(im, p.window.lo, error);
    return code;
}

void impact_clear(impact *im)
{
    pair_heap_clear(&im->heap);
    arena_store_free_room(im->heap.store, im->roots);
    arena_store_free_room(im->heap.store, im->passed);
    arena_store_free_room(im->heap.store, im->trials);
    arena_store_free_room(im->heap.store, im->explained);
    arena_store_free_room(im->heap.store, im->ahead.tests);
    im->roots = NULL;
    im->passed = NULL;
    im->trials = NULL;
    im->explained = NULL;
    im->ahead = (tests_ahead){.tests = NULL};
}
