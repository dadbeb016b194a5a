/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_step.h"

#include "core/bounds/piece_sides.h"

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

imp_code pair_look(const pair *p, candidate_pair *both, double limit, strategy_goal goal,
                   bool keeps_proof, trial_rate *sliding, distance_outcome *seen, imp_error *error)
{
    const slide_signs signs = {.start = p->window.lo,
                               .is_whole = surface_is_whole(p->a->surface, &p->a->region) &&
                                           surface_is_whole(p->b->surface, &p->b->region),
                               .is_parted = vec3_norm1(p->axis) > 0,
                               .slides = p->slides,
                               .sliding = sliding};
    *seen = distance_outcome_none(&p->window);
    if (!p->a->bounded || !p->b->bounded) return IMP_SUCCESS;
    if (pair_has_cluster(p)) {
        const distance_sides sides = sides_of(p, both, keeps_proof);
        const bool is_first = p->a == sides.root[0] && p->b == sides.root[1];
        return is_first ? piece_sides_cut(&sides, 1u << goal, limit, seen, error) : IMP_SUCCESS;
    }
    if (!strategy_takes_distances(p->a, p->b, &signs, goal)) return IMP_SUCCESS;
    distance_sides sides = sides_of(p, both, keeps_proof);
    sides.seeks_contact = goal == GOAL_CONTACT;
    sides.seeks_start = goal == GOAL_CONTACT && signs.is_whole;
    const imp_code code = distance_cut_sides(&sides, limit, seen, error);
    strategy_note_distances(&signs, seen->is_apart || seen->side >= 0);
    return code;
}

/* Where surfaces come to touch along a curve, one side would be split along all of it before the
 * other is small enough for a witness: so a side whose remainder is small is not split alone. */
cut pair_cut_alone(const pair *p, const distance_outcome *seen, double scale)
{
    if (seen->side < 0) return CUT_NONE;
    const node *n = seen->side == 0 ? p->a : p->b;
    const bool matters = n->e[0] + n->e[1] + n->e[2] > scale;
    return matters ? cut_alone(p, seen->side, seen->bend, scale) : CUT_NONE;
}

void pair_push(pair_heap *heap, pair *p, double t, uint64_t *serial, imp_stats *stats)
{
    p->serial = (*serial)++;
    p->key[1] = pair_order(p, t);
    pair_heap_push(heap, p);
    if (heap->count > stats->peak_heap) stats->peak_heap = heap->count;
}
