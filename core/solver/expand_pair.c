/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/expand_pair.h"

#include "core/bounds/separation.h"
#include "core/bounds/tuning.h"
#include "core/solver/explanation.h"
#include "core/solver/pair_note.h"
#include "core/solver/pair_step.h"
#include "core/solver/pair_tubes.h"
#include "core/solver/split_pair.h"
#include "core/witness/contact_estimate.h"
#include "core/witness/newton.h"
#include "core/witness/tube_search.h"
#include "core/witness/wide_search.h"

static resolution resolved(const impact *im) { return resolution_of(im->gamma, im->gamma_clear); }

/* Tubes that seem loose are opened when the pair is cut, and all others of the two surfaces. */
static imp_code seek_in_tubes(const impact *im, const pair *p, witness *seen, imp_error *error)
{
    bool is_loose;
    const imp_code code = witness_seek_in_tubes((const node *const[2]){p->a, p->b}, p->window.lo,
                                                im->gamma, seen, &is_loose, error);
    if (is_loose) im->trials[p->candidate_pair].are_open = true;
    return code;
}

/* Seeks nearest points on the nets where these are close to the surfaces, and evaluates only the
 * points found. */
static imp_code seek_witness(const impact *im, const pair *p, witness *seen, imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    const double t = p->window.lo, room = resolved(im).room, part = 0.25 * room / im->gamma;
    double y[NEWTON_UNKNOWNS];
    if (pair_has_tubes(p)) return seek_in_tubes(im, p, seen, error);
    if (!strategy_has_close_nets(p->a, p->b, room))
        return witness_seek(nodes, t, im->gamma, seen, error);
    net_nearest(nodes, p->axis, t, TUNING_WITNESS_NEAR * im->gamma,
                part < TUNING_NEWTON_GAIN ? part : TUNING_NEWTON_GAIN, y);
    return witness_at(nodes, t, y, seen, error);
}

/* Seeks a witness at the window's start; if not `moving`, evaluates the centres there. */
static imp_code find_witness(impact *im, const pair *p, bool moving, witness *seen,
                             imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    im->stats->witness_searches += 1;
    const imp_code code = moving ? seek_witness(im, p, seen, error)
                                 : witness_at_centres(nodes, p->window.lo, seen, error);
    if (code == IMP_SUCCESS) impact_note_gap(im, seen);
    return code;
}

/* Whether either half of a node without bounds has bounds. */
static imp_code has_bounded_half(impact *im, const pair *p, const cut *c, bool *found,
                                 imp_error *error)
{
    *found = false;
    for (int half = 0; half < 2; ++half) {
        pair child = *p;
        bool some;
        const imp_code code =
            cut_take(c, half, impact_candidates(im, p), &child, &some, im->stats, error);
        if (code != IMP_SUCCESS) return code;
        *found = *found || (c->side == 0 ? child.a : child.b)->bounded;
    }
    return IMP_SUCCESS;
}

/* Chooses the cut of a node without bounds. It cuts time if one half then has bounds, so that a
 * moment without bounds is enclosed before u and v are cut; else pairs with different starts would
 * be expanded one after the other. It also cuts time where the node's times are nearly one moment.
 * Otherwise it cuts the parameter that contributes most. */
static imp_code cut_unbounded(impact *im, const pair *p, int side, cut *best, imp_error *error)
{
    const imp_region *region = side == 0 ? &p->a->region : &p->b->region;
    const cut in_time = {side, PARAMETER_T, 0};
    const double moment = TUNING_MOMENT * (im->window.hi - im->window.lo);
    bool bounded;
    *best = cut_by_contribution(p);
    if (!region_can_split(region, PARAMETER_T)) return IMP_SUCCESS;
    const imp_code code = has_bounded_half(im, p, &in_time, &bounded, error);
    if (bounded || region->d[PARAMETER_T] < moment) *best = in_time;
    return code;
}

/* Splits a node without bounds. If no parameter can be split further, the type has no bounds at
 * that place at any size, which is an error. */
static imp_code expand_unbounded(impact *im, const pair *p, impact_state *state, imp_error *error)
{
    const int side = p->a->bounded ? 1 : 0;
    cut c;
    const imp_code code = cut_unbounded(im, p, side, &c, error);
    explanation_count(im, p, explanation_if_asked(im, p));
    if (code != IMP_SUCCESS) return code;
    if (c.side >= 0) return split_pair(im, p, c, NULL, state, error);
    return node_unbounded_fault(impact_candidates(im, p)->side[side]->tree, side == 0 ? p->a : p->b,
                                error);
}

/* The paper's Figure 6: a pair whose volumes are within gamma of each other altogether (eq. 6) is a
 * collision; any other is subdivided. */
static imp_code expand_by_paper(impact *im, const pair *p, impact_state *state, imp_error *error)
{
    const double farthest = (im->baseline & IMP_BASELINE_BOXES) != 0
                                ? separation_farthest_of_boxes(p->a, p->b)
                                : separation_farthest_of_balls(p->a, p->b);
    if (farthest <= im->gamma && !pair_has_cluster(p)) {
        witness seen;
        const imp_code code = find_witness(im, p, false, &seen, error);
        if (code != IMP_SUCCESS) return code;
        *state = seen.gap_upper <= im->gamma ? impact_contact(im, &seen) : IMPACT_RESOLUTION;
        return IMP_SUCCESS;
    }
    const cut c = cut_by_contribution(p);
    if (c.side >= 0) return split_pair(im, p, c, NULL, state, error);
    *state = IMPACT_RESOLUTION;
    return IMP_SUCCESS;
}

static bool precision_ends(const impact *im, const pair *p, double flat)
{
    return pair_precision_ends(p, impact_candidates(im, p), resolved(im).room, flat);
}

/* Whether a search for a witness is likely to succeed: remainders are small against gamma, or
 * cannot become smaller, or hulls are exact. At one instant it is also tried where one side alone
 * would be split: surfaces that touch everywhere would otherwise be split down to gamma. */
static bool witness_is_likely(const impact *im, const pair *p, const distance_outcome *distances)
{
    if (p->wait > 0) return false;
    if (distances->side >= 0 && !(p->window.lo < p->window.hi)) return true;
    const double remainder = pair_remainder(p);
    return TUNING_WITNESS_GAMMA * remainder <= resolved(im).scale ||
           TUNING_WITNESS_EXTENT * pair_extent(p) <= remainder ||
           strategy_hulls_of(p->a, p->b) == HULLS_FLAT ||
           precision_ends(im, p, TUNING_WITNESS_FLAT);
}

/* Whether its points hardly depend on u and v. */
static bool is_tiny(const impact *im, const pair *p)
{
    return TUNING_TINY * pair_extent(p) <= resolved(im).room;
}

/* Chooses a cut: first of the side that a distance chose; then in time if the motion bends much
 * within the window; else by spread. Where gamma is large and gamma - gamma_clear small, windows of
 * contact are long, and bending motion, not extent, makes their starts inexact. */
static cut choose_cut(const impact *im, const pair *p, const distance_outcome *distances,
                      double gamma)
{
    const double scale = resolved(im).scale;
    const cut alone = pair_cut_alone(p, distances, scale);
    if (alone.side >= 0) return alone;
    const cut bend = scale < gamma ? cut_by_bend(p, scale) : CUT_NONE;
    if (bend.side >= 0) return bend;
    return cut_by_spread(p, scale, strategy_has_both_hulls(p->a, p->b));
}

/* Chooses a cut. A cut in time of which one half contains the whole window is made at once, without
 * another test, and the next one is chosen. */
static imp_code choose_cut_after_free(impact *im, pair *p, const distance_outcome *distances,
                                      cut *c, imp_error *error)
{
    imp_code code = IMP_SUCCESS;
    double gamma = im->gamma;
    int half;
    if (p->tubes != TUBES_NONE) code = pair_tubes_take(im, p, &gamma, error);
    *c = choose_cut(im, p, distances, gamma);
    if (c->side < 0 && pair_tubes_open(im, p)) *c = choose_cut(im, p, distances, gamma);
    while (code == IMP_SUCCESS && cut_is_free(c, p, &half)) {
        bool some;
        code = cut_take(c, half, impact_candidates(im, p), p, &some, im->stats, error);
        if (code == IMP_SUCCESS) code = pair_test_ask_for_nets(im, p, &im->stats->bytes, error);
        if (code == IMP_SUCCESS) *c = choose_cut(im, p, distances, gamma);
    }
    return code;
}

static impact_state end_by_resolution(impact *im, const pair *p)
{
    explanation_count(im, p, IMP_OBSTACLE_RESOLUTION);
    return IMPACT_RESOLUTION;
}

/* Where a ball's distance tells exactly when two whole surfaces may meet, they do, mostly: poles,
 * and what is alike there, need not be divided then. *met: they do. The pair waits then as it is,
 * from that time on, for a smaller gamma. */
static imp_code try_start(impact *im, pair *p, const distance_outcome *distances, bool *met,
                          imp_error *error)
{
    upper_time *up = &im->upper;
    const double start = distances->left.lo;
    *met = false;
    if (!distances->has_start || im->spread != NULL || (up->is_known && up->t <= start))
        return IMP_SUCCESS;
    im->stats->witness_searches += 1;
    const imp_code code = upper_time_try(up, p, start, im->gamma, met, error);
    if (code != IMP_SUCCESS || !*met) return code;
    impact_note_gap(im, &up->seen);
    p->window = distances->left;
    p->key[0] = start;
    p->key[1] = pair_order(p, start);
    pair_heap_push(&im->heap, p);
    return IMP_SUCCESS;
}

/* Whether a contact is to be sought widely at the start of the pair's window. Surfaces that cross
 * there from the beginning would else be divided until their remainders are below gamma, in an
 * order that ties decide. Windows then start where those of half as many pairs before did: where
 * starts move on, such a search, which costs as much as a hundred pairs, is left out. Each
 * candidate pair has a count of its own, in the order in which its pairs are expanded, so that the
 * parts of a divided query seek at the same pairs as the whole. Not where gamma_clear is nearly
 * gamma, as for a required distance: there the bounds themselves tell soon, and contradict a type
 * that lies. */
static bool is_wide_search_due(const impact *im, const pair *p)
{
    if (im->upper.has_nets || im->trials == NULL || im->spread != NULL) return false;
    if (impact_is_narrow(im)) return false;
    pair_trials *trials = &im->trials[p->candidate_pair];
    trials->popped += 1;
    if (trials->next_wide == 0) trials->next_wide = TUNING_WIDE_FIRST;
    if (2 * trials->popped == (uint32_t)TUNING_WIDE_FIRST) trials->start = p->window.lo;
    if (trials->popped < trials->next_wide) return false;
    const double later = TUNING_WIDE_LATER * (im->window.hi - im->window.lo);
    const bool stands = trials->popped == 1 || !(p->window.lo - trials->start > later);
    trials->next_wide = trials->popped + trials->popped / TUNING_WIDE_SHARE + 1;
    trials->start = p->window.lo;
    return stands;
}

/* Keeps the contact that ends the search. If a smaller gamma is asked for, a contact is sought
 * widely from the next pair at once, and intervals begin anew. */
static impact_state end_by_contact(impact *im, const pair *p, const witness *seen)
{
    if (im->trials != NULL) {
        im->trials[p->candidate_pair].popped = 0;
        im->trials[p->candidate_pair].next_wide = 1;
    }
    return impact_contact(im, seen);
}

/* Seeks a contact widely at the start of the pair's window, if that is due. */
static imp_code try_widely(impact *im, const pair *p, impact_state *state, imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    witness seen;
    if (!is_wide_search_due(im, p)) return IMP_SUCCESS;
    im->stats->witness_searches += 1;
    const imp_code code = witness_seek_widely(nodes, p->window.lo, im->gamma, &seen, error);
    if (code != IMP_SUCCESS) return code;
    impact_note_gap(im, &seen);
    if (!(seen.gap_upper <= im->gamma)) return IMP_SUCCESS;
    *state = end_by_contact(im, p, &seen);
    return IMP_SUCCESS;
}

/* The order matters: distances may separate the nodes; clusters are only split; a witness is
 * sought at the window's start as popped, before distances cut it; then the pair is divided. */
static imp_code expand_by_models(impact *im, pair *p, impact_state *state, imp_error *error)
{
    const time_window before = p->window;
    distance_outcome distances;
    const pair_question q = {.limit = im->gamma_clear,
                             .goal = GOAL_CONTACT,
                             .keeps_proof = im->proof != NULL,
                             .sliding = im->trials != NULL ? &im->trials[p->candidate_pair].sliding
                                                           : NULL};
    imp_code code = pair_look(p, impact_candidates(im, p), &q, &distances, error);
    if (code == IMP_SUCCESS && distances.is_apart) pair_note_test(im->proof, p, false);
    if (code != IMP_SUCCESS || distances.is_apart) return code;
    bool met;
    code = try_start(im, p, &distances, &met, error);
    if (code != IMP_SUCCESS || met) return code;
    if (pair_has_cluster(p)) {
        p->window = distances.left;
        explanation_count(im, p, IMP_OBSTACLE_SIZE);
        return split_pair(im, p, cut_by_spread(p, im->gamma, false), NULL, state, error);
    }
    code = try_widely(im, p, state, error);
    if (code != IMP_SUCCESS || *state != IMPACT_RUNNING) return code;
    if (witness_is_likely(im, p, &distances)) {
        witness seen;
        code = find_witness(im, p, true, &seen, error);
        if (code != IMP_SUCCESS) return code;
        if (pair_spread_ends(im, p, &seen))
            *state = end_by_contact(im, p, &seen);
        else if (precision_ends(im, p, 1) && !pair_tubes_open(im, p))
            *state = end_by_resolution(im, p);
        if (*state != IMPACT_RUNNING) return IMP_SUCCESS;
        p->wait = TUNING_WITNESS_WAIT;
    } else if (p->wait > 0) {
        p->wait -= 1;
    }
    p->slides = p->slides || distances.side >= 0;
    p->window = distances.left; /* only now: other pairs may start earlier */
    const imp_obstacle obstacle = explanation_if_asked(im, p);
    pair_note_look(im->proof, p, before);
    bool some;
    cut c;
    net_halves halves;
    code = split_leave_out_halves(im, p, &halves, &some, error);
    if (code == IMP_SUCCESS && !some) return IMP_SUCCESS;
    if (code == IMP_SUCCESS && is_tiny(im, p) && !pair_tubes_open(im, p))
        c = cut_in_time(p);
    else if (code == IMP_SUCCESS)
        code = choose_cut_after_free(im, p, &distances, &c, error);
    if (code == IMP_ERROR_PLUGIN) return code;
    if (code != IMP_SUCCESS) return *state = IMPACT_NO_MEMORY, IMP_SUCCESS;
    if (c.side < 0) return *state = end_by_resolution(im, p), IMP_SUCCESS;
    explanation_count(im, p, obstacle);
    return split_pair(im, p, c, &halves, state, error);
}

imp_code expand_pair(impact *im, pair *p, impact_state *state, imp_error *error)
{
    const imp_code code = pair_measure(p, impact_candidates(im, p), error);
    if (code != IMP_SUCCESS) return code;
    if (!p->a->bounded || !p->b->bounded) return expand_unbounded(im, p, state, error);
    return im->baseline != IMP_BASELINE_NONE ? expand_by_paper(im, p, state, error)
                                             : expand_by_models(im, p, state, error);
}
