/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/upper_time.h"

#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "core/witness/contact_estimate.h"
#include "core/witness/wide_search.h"

/* Nearest points are followed until their gap is this part of gamma, which leaves a margin for
 * rounding and the net's error and is well above gamma_clear. */
#define TOUCHING 0.875

/* Whether the pair contains the points of the known contact, which would be found again. */
static bool holds_contact(const upper_time *up, const pair *p)
{
    const node *const nodes[2] = {p->a, p->b};
    if (!up->is_known || up->candidate_pair != p->candidate_pair) return false;
    for (int side = 0; side < 2; ++side) {
        const imp_region *r = &nodes[side]->region;
        if (surface_piece_index(nodes[side]->surface) != up->seen.piece[side]) return false;
        if (!(r->lo[0] <= up->seen.u[side] && up->seen.u[side] <= r->hi[0])) return false;
        if (!(r->lo[1] <= up->seen.v[side] && up->seen.v[side] <= r->hi[1])) return false;
    }
    return true;
}

static bool is_wanted(upper_time *up, const pair *p)
{
    up->has_nets = strategy_has_both_hulls(p->a, p->b);
    if (!up->has_nets) return false;
    up->followed += 1;
    if (up->next == 0) up->next = TUNING_UPPER_FIRST;
    if (up->followed < up->next || holds_contact(up, p)) return false;
    up->next = up->followed + up->followed / TUNING_UPPER_SHARE + 1;
    return true;
}

/* Keeps a contact. The horizon is the time at which the gap is predicted to be 0: a smaller gamma
 * is reached before it, so that the later parts of windows are not needed again. */
static void take(upper_time *up, const pair *p, const contact_estimate *met, const witness *seen)
{
    const double rest = 2 * seen->gap / met->speed;
    up->is_known = up->has_horizon = true;
    up->t = met->t;
    up->seen = *seen;
    up->candidate_pair = p->candidate_pair;
    up->paraboloid = met->paraboloid;
    up->count += 1;
    up->horizon = met->t + (rest > 0 && rest < INFINITY ? rest : 0);
}

imp_code upper_time_follow(upper_time *up, const pair *p, double gamma, bool *sought,
                           imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    time_window window = p->window;
    contact_estimate met;
    witness seen;
    *sought = is_wanted(up, p);
    if (!*sought) return IMP_SUCCESS;
    if (up->is_known && up->t < window.hi) window.hi = up->t;
    if (!contact_estimate_find(p->a, p->b, p->axis, &window, TOUCHING * gamma, &met))
        return IMP_SUCCESS;
    const imp_code code = witness_at(nodes, met.t, met.y, &seen, error);
    if (code != IMP_SUCCESS) return code;
    if (seen.gap_upper <= gamma && !(up->is_known && up->t <= met.t)) take(up, p, &met, &seen);
    return IMP_SUCCESS;
}

void upper_time_note(upper_time *up, const pair *p, double t, double gamma, const witness *seen)
{
    if (!(seen->gap_upper <= gamma)) return;
    up->is_known = true;
    up->has_horizon = false;
    up->t = t;
    up->seen = *seen;
    up->candidate_pair = p->candidate_pair;
}

imp_code upper_time_try(upper_time *up, const pair *p, double start, double gamma, bool *met,
                        imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    witness seen;
    const imp_code code = witness_seek_widely(nodes, start, gamma, &seen, error);
    *met = code == IMP_SUCCESS && seen.gap_upper <= gamma;
    if (*met) upper_time_note(up, p, start, gamma, &seen);
    return code;
}

void upper_time_refine(upper_time *up, double gamma)
{
    if (!up->is_known || up->seen.gap_upper <= gamma) return;
    up->is_known = false;
    up->next = up->followed;
}
