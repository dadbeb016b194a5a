/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_tubes.h"

#include "core/base/rounding.h"
#include "core/bounds/tuning.h"
#include "core/solver/split_pair.h"

/* Whether any two points of the lines are nearer to each other at the window's start than both
 * balls reach, about. */
static bool tubes_cross(const pair *p)
{
    const double centres = sqrt(separation_centres(p->a, p->b, p->window.lo));
    return centres + pair_extent(p) + pair_remainder(p) < p->a->ball + p->b->ball;
}

/* Nets are closer to surfaces that have them. */
static bool is_to_be_tube(const node *n)
{
    return surface_offers_tube(n->surface) && !surface_offers_net(n->surface) &&
           n->parent == NULL && n->many == NULL;
}

/* Opens the pair if the tubes of its two surfaces do not tell how far these are apart, at its own
 * place or at another that was popped before; or if they have taken long, where surfaces touch all
 * along a curve. */
static void open_if_due(pair_trials *trials, pair *p)
{
    trials->tubes += 1;
    if (tubes_cross(p) || trials->tubes >= (uint32_t)TUNING_TUBES_MOST) trials->are_open = true;
    if (trials->are_open) p->tubes = TUBES_OPEN;
}

/* Where a type states no line for one side, both sides stay as they are. */
static imp_code take_tubes(const impact *im, pair *p, imp_error *error)
{
    const candidate_pair *both = impact_candidates(im, p);
    node *a = p->a, *b = p->b;
    tree_growth growth = {0};
    imp_code code = node_tube(both->side[0]->tree, a, &a, &growth, error);
    if (code == IMP_SUCCESS) code = node_tube(both->side[1]->tree, b, &b, &growth, error);
    if (code == IMP_SUCCESS && a->ball > 0 && b->ball > 0)
        p->a = a, p->b = b, p->tubes = TUBES_CLOSED;
    im->stats->nodes += growth.nodes;
    im->stats->bytes += growth.bytes;
    return code;
}

static imp_code take(const impact *im, pair *p, imp_error *error)
{
    const bool is_whole = p->tubes == TUBES_WHOLE;
    if (pair_has_tubes(p)) open_if_due(&im->trials[p->candidate_pair], p);
    if (!is_whole) return IMP_SUCCESS;
    p->tubes = TUBES_NONE;
    if (!is_to_be_tube(p->a) || !is_to_be_tube(p->b)) return IMP_SUCCESS;
    if (im->trials == NULL || im->proof != NULL || im->spread != NULL) return IMP_SUCCESS;
    if (impact_is_narrow(im)) return IMP_SUCCESS;
    /* In a half plane surfaces count as curves already. */
    if (impact_candidates(im, p)->side[0]->half != NULL) return IMP_SUCCESS;
    return im->trials[p->candidate_pair].are_open ? IMP_SUCCESS : take_tubes(im, p, error);
}

imp_code pair_tubes_take(const impact *im, pair *p, double *gamma, imp_error *error)
{
    const imp_code code = take(im, p, error);
    if (p->tubes == TUBES_CLOSED) *gamma = sum_upper(*gamma, sum_upper(p->a->ball, p->b->ball));
    return code;
}

bool pair_tubes_open(pair *p)
{
    if (p->tubes != TUBES_CLOSED) return false;
    p->tubes = TUBES_OPEN;
    return true;
}
