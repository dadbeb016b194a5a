/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/clearance_internal.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/scene/tolerances.h"
#include "core/solver/contradiction.h"
#include "core/solver/world.h"

/* What both searches of a task share: the distances they prove, turns, witnesses. */

double clearance_relaxed(const clearance_search *c) { return tolerances_nearly(c->asked.required); }

double clearance_kept(const clearance_search *c)
{
    return c->proof != NULL ? 0.5 * clearance_relaxed(c) + 0.5 * c->asked.required
                            : clearance_relaxed(c);
}

double clearance_slip(const clearance_search *c)
{
    return c->moments.slip > 0 ? sum_upper(c->list->slip, c->moments.slip) : c->list->slip;
}

double clearance_searched(const clearance_search *c)
{
    const double slip = clearance_slip(c);
    return slip > 0 ? sum_upper(clearance_kept(c), 2 * slip) : clearance_kept(c);
}

const clearance_group *clearance_group_of(const clearance_search *c)
{
    return &c->groups[c->current / c->asked.slices];
}

bool clearance_decides(const clearance_search *c)
{
    return c->asked.decide && c->asked.required > 0;
}

bool clearance_turn_ends(clearance_search *c)
{
    if (c->stats->pairs - c->turn_from <= c->turn) return false;
    c->turn_from = c->stats->pairs;
    if (c->takes_turns && c->stage == STAGE_DISTANCE) c->turn *= 2;
    return true;
}

imp_code clearance_take_witness(const clearance_search *c, uint32_t k, const witness *w, double t,
                                imp_clearance *answer, imp_error *error)
{
    world_witness in_world;
    const imp_code code =
        world_witness_of(c->scene, &c->list->pairs[k], w, t, INFINITY, &in_world, error);
    if (code != IMP_SUCCESS) return code;
    answer->has_witness = true;
    answer->upper = w->gap_upper;
    answer->t = t;
    answer->a = in_world.side[0];
    answer->b = in_world.side[1];
    answer->has_normal = w->has_normal;
    memcpy(answer->normal, in_world.normal, sizeof answer->normal);
    return IMP_SUCCESS;
}

/* Lemma. No points are nearer than `lower` before time t, and those of the witness are at most
 * `upper` apart, up to the slip of pairs that are searched at one moment. */
imp_code clearance_check_witness(const clearance_search *c, const imp_clearance *answer,
                                 double lower, double t, imp_error *error)
{
    const double upper = sum_upper(answer->upper, 2 * clearance_slip(c));
    if (!answer->has_witness || !(upper < lower && answer->t < t)) return IMP_SUCCESS;
    return contradiction_fault(scene_surface(c->scene, answer->a.body, answer->a.surface),
                               scene_surface(c->scene, answer->b.body, answer->b.surface), upper,
                               answer->t, lower, error);
}
