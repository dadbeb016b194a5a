/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/candidates_rest.h"

#include "core/base/status.h"

static size_t count_resting(const candidate_pair *pairs, size_t count)
{
    size_t sides = 0;
    for (size_t k = 0; k < count; ++k) sides += pairs[k].rests ? 2 : 0;
    return sides;
}

/* Returns the times of a slice at which both surfaces of a pair exist. */
static time_window times_in(const candidate_pair *p, const time_window *within)
{
    return window_common(*within,
                         pair_times(tree_root(p->side[0]->tree), tree_root(p->side[1]->tree)));
}

/* Makes the tree of a side at this moment. */
static imp_code begin_moment(const candidate_pair *p, int side, double moment, candidate_moment *m,
                             imp_stats *stats, imp_error *error)
{
    tree_growth growth = {0};
    m->side = side;
    m->whole = p->side[side];
    m->at = *m->whole;
    const imp_code code = tree_new_at(m->whole->tree, moment, &m->at.tree, &growth, error);
    m->at.eval_error = -1;
    stats->nodes += growth.nodes;
    stats->bytes += growth.bytes;
    return code;
}

imp_code candidates_rest(const candidate_list *list, size_t first, size_t count,
                         const time_window *within, candidate_moments *moments, imp_stats *stats,
                         imp_error *error)
{
    candidate_pair *pairs = list->pairs;
    const size_t sides = count_resting(pairs + first, count);
    if (sides == 0) return IMP_SUCCESS;
    moments->at = arena_store_room(list->store, sides * sizeof *moments->at);
    if (moments->at == NULL) return error_set_memory(error);
    moments->capacity = sides;
    imp_code code = IMP_SUCCESS;
    for (size_t k = first; k < first + count && code == IMP_SUCCESS; ++k) {
        if (!pairs[k].rests) continue;
        const time_window times = times_in(&pairs[k], within);
        for (int side = 0; side < 2 && times.lo <= times.hi && code == IMP_SUCCESS; ++side) {
            candidate_moment *m = &moments->at[moments->count];
            m->pair = k;
            code = begin_moment(&pairs[k], side, times.lo, m, stats, error);
            moments->count += code == IMP_SUCCESS;
        }
    }
    for (size_t j = 0; j < moments->count && code == IMP_SUCCESS; ++j)
        pairs[moments->at[j].pair].side[moments->at[j].side] = &moments->at[j].at;
    if (code != IMP_SUCCESS) candidates_wake(list, moments, stats);
    return code;
}

void candidates_wake(const candidate_list *list, candidate_moments *moments, imp_stats *stats)
{
    for (size_t j = 0; j < moments->count; ++j) {
        candidate_moment *m = &moments->at[j];
        list->pairs[m->pair].side[m->side] = m->whole;
        stats->bytes -= tree_own_bytes(m->at.tree);
        tree_free(m->at.tree);
    }
    arena_store_free_room(list->store, moments->at);
    *moments = (candidate_moments){0};
}
