/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/status.h"
#include "core/scene/tolerances.h"
#include "core/solver/clearance_internal.h"

/* Bodies inside solid ones, asked before the distance of a task is searched for. */

/* Lemma. Bodies whose surfaces are proved to keep at least gamma_clear in one slice, and one of
 * which was not inside the other when it began, are not inside each other when it ends: a smaller
 * one may pass a gap that counts as closed (inside.c). */
static bool is_known(clearance_search *c)
{
    const bool is_next_slice = c->current % c->asked.slices != 0;
    const bool known = is_next_slice && c->known_outside;
    c->known_outside = false;
    return known;
}

static imp_code begin(clearance_search *c, imp_error *error)
{
    const imp_options *o = &c->options;
    const inside_plan plan = {c->scene,   o->gamma, tolerances_clear(o->gamma, o->gamma_clear),
                              o->t_start, o->t_end, c->watch,
                              INFINITY};
    if (c->insides == NULL) c->insides = inside_new(&plan);
    return c->insides != NULL ? IMP_SUCCESS : error_set_memory(error);
}

imp_code clearance_look_inside(clearance_search *c, const clearance_group *group,
                               inside_answer *found, imp_error *error)
{
    *found = (inside_answer){.state = INSIDE_NOBODY};
    c->inside_unknown = false;
    if (!scene_has_solids(c->scene) || is_known(c)) return IMP_SUCCESS;
    imp_code code = begin(c, error);
    for (size_t k = 0; code == IMP_SUCCESS && k < group->count; ++k) {
        const candidate_pair *pairs = c->list->pairs + group->first;
        tree_growth growth = {0};
        if (!candidate_pair_is_first(pairs, k)) continue;
        const size_t body[2] = {pairs[k].side[0]->body, pairs[k].side[1]->body};
        code = inside_find(c->insides, body, c->answer.t_start, found, &growth, error);
        c->stats->nodes += growth.nodes;
        c->stats->bytes += growth.bytes;
        c->inside_unknown = c->inside_unknown || found->state == INSIDE_UNKNOWN;
        if (found->state == INSIDE_FOUND || found->state == INSIDE_STOPPED) break;
    }
    return code;
}
