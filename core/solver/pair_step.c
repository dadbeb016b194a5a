/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_step.h"

#include "core/base/rounding.h"
#include "core/bounds/piece_sides.h"
#include "core/bounds/spine.h"

imp_code pair_measure(const pair *p, const candidate_pair *both, imp_error *error)
{
    return pair_has_cluster(p) ? IMP_SUCCESS : candidate_pair_measure(both, error);
}

/* Returns the input of distance_cut_sides; the slips are stored in the candidate pair. */
static distance_sides sides_of(const pair *p, candidate_pair *both, bool keeps_proof)
{
    const candidate *a = both->side[0], *b = both->side[1];
    return (distance_sides){.node = {p->a, p->b},
                            .root = {tree_root(a->tree), tree_root(b->tree)},
                            .still_maps = {a->still_maps, b->still_maps},
                            .slips = &both->slips,
                            .store = tree_store(a->tree),
                            .takes_orbits = !keeps_proof,
                            .is_audited = tree_is_audited(a->tree)};
}

/* --- Spines ----------------------------------------------------------------------------------- */

/* Spines are tried once this many pairs of two surfaces have been looked at, since most need fewer,
 * and as many pairs later if the limit of a minimum distance has fallen to where they may do. */
enum { LOOKS_BEFORE_SPINES = 8 };

static bool are_spines_due(distance_slips *slips, double limit)
{
    slips->looks += slips->looks <= LOOKS_BEFORE_SPINES;
    return slips->looks == LOOKS_BEFORE_SPINES ||
           (slips->looks > LOOKS_BEFORE_SPINES && limit < slips->hope);
}

/* Whether both surfaces are farther apart than the limit, at all times of the search. */
static imp_code look_at_spines(const pair *p, candidate_pair *both, const pair_question *q,
                               distance_outcome *seen, imp_error *error)
{
    distance_slips *slips = &both->slips;
    if (q->keeps_proof || p->tubes == TUBES_CLOSED) return IMP_SUCCESS;
    if (!(slips->apart > q->limit) && are_spines_due(slips, q->limit)) {
        const distance_sides sides = sides_of(p, both, false);
        const time_window all = pair_times(sides.root[0], sides.root[1]),
                          times = q->within != NULL ? window_common(all, *q->within) : all;
        double lower, hope;
        const imp_code code = spine_part(&sides, &times, q->limit, &lower, &hope, error);
        if (code != IMP_SUCCESS) return code;
        if (lower > slips->apart) slips->apart = -float_upper(-lower);
        slips->hope = (float)hope;
    }
    if (slips->apart > seen->lower) seen->lower = slips->apart;
    seen->is_apart = slips->apart > q->limit;
    return IMP_SUCCESS;
}

/* Forgets slips over the times of trees that the pair has no more. Where none is known, or none is
 * of use, that holds at all times. */
static void forget_slips(distance_slips *slips)
{
    for (int k = 0; k < 2; ++k) {
        float *const of[] = {&slips->slip[k], &slips->carry[k], &slips->ball[k], &slips->orbit[k]};
        for (size_t j = 0; j < sizeof of / sizeof *of; ++j)
            if (*of[j] < INFINITY) *of[j] = 0;
    }
}

void pair_look_anew(candidate_pair *both)
{
    both->slips.searches = 0;
    both->slips.apart = both->slips.hope = 0;
    both->slips.looks = 0;
    if (both->rests || both->screws) forget_slips(&both->slips);
}

/* --- Looks ------------------------------------------------------------------------------------ */

/* Whether the node has all points of the surface, at some times. */
static bool is_all_of(const node *n, const node *root)
{
    return root->many != NULL ? n->many == root->many : surface_is_whole(n->surface, &n->region);
}

static imp_code look_at_nodes(const pair *p, candidate_pair *both, const pair_question *q,
                              distance_outcome *seen, imp_error *error)
{
    const slide_signs signs = {.start = p->window.lo,
                               .is_whole = surface_is_whole(p->a->surface, &p->a->region) &&
                                           surface_is_whole(p->b->surface, &p->b->region),
                               .is_parted = vec3_norm1(p->axis) > 0,
                               .slides = p->slides,
                               .sliding = q->sliding};
    if (!p->a->bounded || !p->b->bounded) return IMP_SUCCESS;
    if (pair_has_cluster(p)) {
        const distance_sides sides = sides_of(p, both, q->keeps_proof);
        const bool is_first = is_all_of(p->a, sides.root[0]) && is_all_of(p->b, sides.root[1]);
        return is_first ? piece_sides_cut(&sides, 1u << q->goal, q->limit, seen, error)
                        : IMP_SUCCESS;
    }
    if (!strategy_takes_distances(p->a, p->b, &signs, q->goal)) return IMP_SUCCESS;
    if (p->a->ball > 0 || p->b->ball > 0) return IMP_SUCCESS; /* lines tell no distances */
    distance_sides sides = sides_of(p, both, q->keeps_proof);
    sides.seeks_contact = q->goal == GOAL_CONTACT;
    sides.seeks_start = q->goal == GOAL_CONTACT && signs.is_whole;
    const imp_code code = distance_cut_sides(&sides, q->limit, seen, error);
    strategy_note_distances(&signs, seen->is_apart || seen->side >= 0);
    return code;
}

imp_code pair_look(const pair *p, candidate_pair *both, const pair_question *q,
                   distance_outcome *seen, imp_error *error)
{
    *seen = distance_outcome_none(&p->window);
    const imp_code code = look_at_spines(p, both, q, seen, error);
    return code != IMP_SUCCESS || seen->is_apart ? code : look_at_nodes(p, both, q, seen, error);
}

/* Where surfaces come to touch along a curve, one side would be split along all of it before the
 * other is small enough for a witness: so a side whose remainder is small is not split alone. */
cut pair_cut_alone(const pair *p, const distance_outcome *seen, double scale)
{
    if (seen->side < 0) return CUT_NONE;
    const node *n = seen->side == 0 ? p->a : p->b;
    return node_blurs_sum(n) > scale ? cut_alone(p, seen->side, seen->bend, scale) : CUT_NONE;
}

void pair_push(pair_heap *heap, pair *p, double t, uint64_t *serial, imp_stats *stats)
{
    p->serial = (*serial)++;
    p->key[1] = pair_order(p, t);
    pair_heap_push(heap, p);
    if (heap->count > stats->peak_heap) stats->peak_heap = heap->count;
}
