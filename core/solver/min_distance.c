/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/min_distance.h"

#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"
#include "core/bounds/separation.h"
#include "core/bounds/tuning.h"
#include "core/solver/contradiction.h"
#include "core/solver/pair_note.h"
#include "core/solver/pair_step.h"
#include "core/solver/piece_walk.h"
#include "core/witness/time_descent.h"

/* --- Bounds and limits ------------------------------------------------------------------------ */

/* Returns the distance above which pairs are pruned. Lemma. In the end lower is at least (1 - R')
 * upper with R' = R (1 - 2^-20), off by 4 u upper at most; as R >= 2^-30, upper - lower is then at
 * most R upper. The slip, which is taken off in the end, is added first where R leaves room for it.
 * Where a distance is required, upper is above it and (1 - R') upper below, the bracket is narrowed
 * until lower reaches `relaxed`. */
static double enough(const min_distance *m)
{
    double part = (1 - m->tolerance * (1 - 0x1p-20)) * m->upper;
    if (m->slip > 0 && 4 * m->slip <= m->tolerance * m->upper) part = sum_upper(part, m->slip);
    return m->upper > m->required && part < m->relaxed ? m->relaxed : part;
}

double min_distance_enough(const min_distance *m) { return enough(m); }

static resolution resolved(const min_distance *m) { return resolution_of(m->upper, enough(m)); }

/* Returns a lower bound of the distances of all pairs that are not on the heap. */
static double settled(const min_distance *m)
{
    const double pruned = enough(m);
    return pruned < m->stuck ? pruned : m->stuck;
}

/* Returns the least lower bound of the pairs on the heap and of those not begun. */
static double waiting(const min_distance *m)
{
    const double start = m->start_count > 0 ? m->starts[m->start_count - 1].key[0] : INFINITY;
    const double top = m->heap.count > 0 ? pair_heap_first(&m->heap) : INFINITY;
    return start < top ? start : top;
}

double min_distance_lower(const min_distance *m)
{
    const double aside = settled(m), next = waiting(m), lower = aside < next ? aside : next;
    if (!(m->slip > 0)) return lower;
    return lower > m->slip ? difference_lower(lower, m->slip) : 0;
}

/* --- The first pairs -------------------------------------------------------------------------- */

/* Replaces the side's node by the smallest node in time that contains the window. */
static imp_code descend_in_time(min_distance *m, const candidate_pair *both, pair *p, int side,
                                imp_error *error)
{
    for (;;) {
        const imp_region *r = side == 0 ? &p->a->region : &p->b->region;
        const double at = r->c[PARAMETER_T];
        const bool below = p->window.hi <= at, above = p->window.lo >= at;
        if ((!below && !above) || !region_can_split(r, PARAMETER_T)) return IMP_SUCCESS;
        const cut c = {side, PARAMETER_T, 0};
        bool some;
        const imp_code code = cut_take(&c, above, both, p, &some, m->stats, error);
        if (code != IMP_SUCCESS || !some) return code;
    }
}

static imp_code add_start(min_distance *m, uint32_t index, imp_error *error)
{
    const candidate_pair *both = &m->candidates[index];
    pair p = {.a = tree_root(both->side[0]->tree),
              .b = tree_root(both->side[1]->tree),
              .serial = index,
              .candidate_pair = index,
              .proof = index};
    p.window = window_common(m->window, pair_times(p.a, p.b));
    if (p.window.lo > p.window.hi) return IMP_SUCCESS;
    imp_code code = descend_in_time(m, both, &p, 0, error);
    if (code == IMP_SUCCESS) code = descend_in_time(m, both, &p, 1, error);
    p.key[0] = p.a->bounded && p.b->bounded ? separation_boxes_lower(p.a, p.b) : 0;
    p.moment = 0.5 * p.window.lo + 0.5 * p.window.hi;
    m->starts[m->start_count++] = p;
    return code;
}

static int farthest_first(const void *x, const void *y)
{
    const pair *p = x, *q = y;
    if (p->key[0] != q->key[0]) return p->key[0] > q->key[0] ? -1 : 1;
    return p->serial > q->serial ? -1 : p->serial < q->serial;
}

imp_code min_distance_begin(min_distance *m, size_t first, size_t count, imp_error *error)
{
    m->upper = m->stuck = INFINITY;
    m->starts = arena_store_room(m->heap.store, (count + 1) * sizeof *m->starts);
    if (m->starts == NULL) return error_set_memory(error);
    m->start_capacity = count + 1;
    for (size_t k = 0; k < count; ++k) {
        const imp_code code = add_start(m, (uint32_t)(first + k), error);
        if (code != IMP_SUCCESS) return code;
    }
    if (m->start_count > 1) qsort(m->starts, m->start_count, sizeof *m->starts, farthest_first);
    return IMP_SUCCESS;
}

/* --- Test and push ---------------------------------------------------------------------------- */

/* Lemma. A pair's first key bounds the distance of its points over its window from below, or is
 * `enough` or more; at times cut off the window the distance is at least `enough` of that moment,
 * which is no less than now, since upper only falls. A child's points and times are its parent's,
 * so the parent's bound holds too, and is all that is known where max_pairs lets no pair be tested
 * any more. */
static void test_and_push(min_distance *m, pair p)
{
    approach near = {0, p.moment};
    bool some = true;
    if (!pairs_are_spent(m->stats, m->max_pairs)) {
        m->stats->pairs += 1;
        some = separation_approach(p.a, p.b, enough(m), &p.window, &p.axis, &near);
    }
    pair_note_test(m->proof, &p, some);
    if (!some) return;
    p.moment = near.moment < p.window.lo   ? p.window.lo
               : near.moment > p.window.hi ? p.window.hi
                                           : near.moment;
    if (near.lower > p.key[0]) p.key[0] = near.lower;
    if (p.key[0] > enough(m)) return;
    pair_push(&m->heap, &p, p.moment, &m->serial, m->stats);
}

/* --- Expanding one pair ----------------------------------------------------------------------- */

/* Moves a witness that lowers `upper` to the time at which its gap is least, if the bracket is
 * to become narrow. */
static imp_code lower_in_time(min_distance *m, const node *const nodes[2], double *t, witness *seen,
                              imp_error *error)
{
    const time_window times = window_common(m->window, pair_times(nodes[0], nodes[1]));
    const double part = TUNING_DESCENT_GAIN * m->tolerance;
    size_t searches = 0;
    if (m->required > 0) return IMP_SUCCESS;
    imp_code code = witness_polish(nodes, *t, seen, error);
    if (code == IMP_SUCCESS)
        code = witness_descend_in_time(nodes, &times, part, t, seen, &searches, error);
    m->stats->witness_searches += searches;
    return code;
}

/* Lets the witness at p->moment of two pieces walk to their neighbours. A walk may end where only
 * a step of both sides would lead nearer: one that ends too far from the pair's bound to prune the
 * pair is tried once more from its start, with the other side's pieces first. */
static imp_code walk_on(min_distance *m, const pair *p, pair *single, witness *seen,
                        imp_error *error)
{
    const candidate_pair *both = &m->candidates[p->candidate_pair];
    const piece_walk start = {*single, *seen, p->moment, 0};
    for (int first = 0; first < 2; ++first) {
        piece_walk w = start;
        w.first = first;
        if (first > 0 && (1 - m->tolerance) * seen->gap_upper <= p->key[0]) return IMP_SUCCESS;
        const imp_code code = piece_walk_on(&w, p, both, m->stats, error);
        if (code != IMP_SUCCESS) return code;
        if (first > 0 && !(w.seen.gap_upper < seen->gap_upper)) return IMP_SUCCESS;
        *single = w.single;
        *seen = w.seen;
    }
    return IMP_SUCCESS;
}

/* Among the pieces that the hint names, or else that are nearest. */
static imp_code find_witness(min_distance *m, const pair *p, const piece_hint *hint,
                             imp_error *error)
{
    const candidate_pair *both = &m->candidates[p->candidate_pair];
    pair single = *p;
    witness seen;
    imp_code code = IMP_SUCCESS;
    if (hint != NULL) code = pair_descend_to(&single, hint->piece, both, m->stats, error);
    if (code == IMP_SUCCESS) code = pair_descend(&single, both, m->stats, error);
    if (code != IMP_SUCCESS) return code;
    const node *nodes[2] = {single.a, single.b};
    double t = p->moment;
    m->stats->witness_searches += 1;
    code = witness_seek(nodes, t, m->upper, &seen, error);
    if (code == IMP_SUCCESS && hint != NULL) code = walk_on(m, p, &single, &seen, error);
    if (code != IMP_SUCCESS || !(seen.gap_upper < m->upper)) return code;
    if (sum_upper(seen.gap_upper, m->slip) < p->key[0])
        return contradiction_fault(single.a->surface, single.b->surface, seen.gap_upper, t,
                                   p->key[0], error);
    nodes[0] = single.a, nodes[1] = single.b;
    code = lower_in_time(m, nodes, &t, &seen, error);
    if (code != IMP_SUCCESS) return code;
    m->upper = seen.gap_upper;
    m->found = seen;
    m->t = t;
    m->candidate = p->candidate_pair;
    return IMP_SUCCESS;
}

static imp_code take_start(min_distance *m, imp_error *error)
{
    const pair p = m->starts[m->start_count - 1];
    imp_code code = pair_measure(&p, &m->candidates[p.candidate_pair], error);
    if (code == IMP_SUCCESS) code = find_witness(m, &p, NULL, error);
    if (code != IMP_SUCCESS) return code;
    m->start_count -= 1;
    test_and_push(m, p);
    return IMP_SUCCESS;
}

static imp_code split(min_distance *m, const pair *p, cut c, imp_error *error)
{
    for (int half = 0; half < 2; ++half) {
        pair child = *p;
        bool some;
        const imp_code code =
            cut_take(&c, half, &m->candidates[p->candidate_pair], &child, &some, m->stats, error);
        if (code != IMP_SUCCESS) return code;
        if (!some || pair_is_left_out(&child, &m->candidates[p->candidate_pair])) continue;
        pair_note_cut(m->proof, &child, &c, half);
        test_and_push(m, child);
    }
    return IMP_SUCCESS;
}

static cut choose_cut(const min_distance *m, const pair *p, const distance_outcome *seen)
{
    const resolution r = resolved(m);
    if (pair_has_cluster(p)) return cut_by_spread(p, r.scale, false);
    if (pair_precision_ends(p, &m->candidates[p->candidate_pair], r.room, 1)) return CUT_NONE;
    if (TUNING_TINY * pair_extent(p) <= r.room) return cut_in_time(p);
    const cut alone = pair_cut_alone(p, seen, r.scale);
    return alone.side >= 0 ? alone : cut_by_spread(p, r.scale, false);
}

/* Lemma. At the times that one-sided distances cut off p->window the nodes are farther apart than
 * `enough`, and at the other times no nearer than seen->lower, so that p->key[0] stays a bound. */
static imp_code look(min_distance *m, pair *p, distance_outcome *seen, imp_error *error)
{
    const pair_question q = {.limit = enough(m),
                             .goal = GOAL_DISTANCE,
                             .keeps_proof = m->proof != NULL,
                             .within = &m->window};
    const imp_code code = pair_look(p, &m->candidates[p->candidate_pair], &q, seen, error);
    const time_window before = p->window;
    p->window = seen->left;
    pair_note_look(m->proof, p, before);
    p->slides = p->slides || seen->side >= 0;
    if (seen->lower > p->key[0]) p->key[0] = seen->lower;
    return code;
}

static imp_code follow(min_distance *m, pair p, imp_error *error)
{
    distance_outcome seen;
    imp_code code = pair_measure(&p, &m->candidates[p.candidate_pair], error);
    if (code == IMP_SUCCESS && p.wait == 0) code = find_witness(m, &p, NULL, error);
    if (code != IMP_SUCCESS) return code;
    p.wait = p.wait == 0 ? TUNING_WITNESS_WAIT : p.wait - 1;
    code = look(m, &p, &seen, error);
    if (code == IMP_SUCCESS && !seen.is_apart && seen.hint.is_known)
        code = find_witness(m, &p, &seen.hint, error);
    if (code != IMP_SUCCESS || seen.is_apart || p.key[0] > enough(m)) return code;
    const cut c = choose_cut(m, &p, &seen);
    if (c.side >= 0) return split(m, &p, c, error);
    if (p.key[0] < m->stuck) m->stuck = p.key[0];
    return IMP_SUCCESS;
}

/* Expands the pair of least bound: the next candidate pair, or the first pair of the heap. */
static imp_code take_one(min_distance *m, imp_error *error)
{
    if (m->start_count > 0 && m->starts[m->start_count - 1].key[0] <= waiting(m))
        return take_start(m, error);
    const pair p = pair_heap_pop(&m->heap);
    const imp_code code = follow(m, p, error);
    if (code != IMP_SUCCESS) pair_heap_push(&m->heap, &p);
    return code;
}

/* Expanding replaces a pair by at most two; on failure it may push one, and the pair is pushed
 * again. */
imp_code min_distance_advance(min_distance *m, min_distance_state *state, imp_error *error)
{
    *state = MIN_DISTANCE_NO_MEMORY;
    if (!pair_heap_reserve(&m->heap, 1)) return IMP_SUCCESS;
    *state = MIN_DISTANCE_RUNNING;
    if (m->upper > m->gamma && waiting(m) < settled(m)) return take_one(m, error);
    const bool stuck = m->upper > m->gamma && m->stuck < enough(m);
    *state = stuck ? MIN_DISTANCE_RESOLUTION : MIN_DISTANCE_DONE;
    return IMP_SUCCESS;
}

void min_distance_clear(min_distance *m)
{
    arena_store_free_room(m->heap.store, m->starts);
    m->starts = NULL;
    m->start_count = m->start_capacity = 0;
    pair_heap_clear(&m->heap);
}
