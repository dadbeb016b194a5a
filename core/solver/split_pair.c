/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/split_pair.h"

#include "core/bounds/strategy.h"
#include "core/solver/pair_note.h"
#include "core/solver/pair_step.h"
#include "core/solver/pair_test.h"

/* Tests a child and pushes it. Precondition: p->window is the parent's window, cut to both nodes'
 * times. */
static imp_code test_and_push(impact *im, const pair *p, imp_error *error)
{
    pair_test t = {.p = *p};
    const imp_code code = pair_test_first(im, &t, impact_turning(im, p), error);
    if (code == IMP_SUCCESS) impact_push(im, &t);
    return code;
}

/* Pushes a pair whose window the hulls have cut already: it is tested when it is popped. */
static imp_code push_cut(impact *im, const pair *p, imp_error *error)
{
    pair_test t = {.p = *p, .near = true};
    t.p.is_seen_only = true;
    const imp_code code = pair_test_ask_for_nets(im, &t.p, &t.bytes, error);
    if (code == IMP_SUCCESS) impact_push(im, &t);
    return code;
}

/* Lemma. A half's points and times are the pair's, so that its window holds for the half, too: one
 * that is not tested loses nothing. */
static imp_code push_half(impact *im, const pair *half, bool is_cut, imp_error *error)
{
    if (pairs_are_spent(im->stats, im->max_pairs)) {
        impact_push_untested(im, half);
        return IMP_SUCCESS;
    }
    return is_cut ? push_cut(im, half, error) : test_and_push(im, half, error);
}

imp_code split_pair(impact *im, const pair *p, cut c, const net_halves *halves, impact_state *state,
                    imp_error *error)
{
    time_window left[2] = {p->window, p->window};
    bool near[2] = {true, true};
    const bool is_cut =
        halves != NULL && net_halves_cut(halves, c.side, c.along, &p->window, left, near);
    for (int half = 0; half < 2; ++half) {
        pair child = *p;
        child.window = left[half];
        bool some = false;
        imp_code code = IMP_SUCCESS;
        if (near[half])
            code = cut_take(&c, half, impact_candidates(im, p), &child, &some, im->stats, error);
        some = some && !pair_is_left_out(&child, impact_candidates(im, p));
        if (code == IMP_SUCCESS && some) pair_note_cut(im->proof, &child, &c, half);
        if (code == IMP_SUCCESS && some) code = push_half(im, &child, is_cut, error);
        if (code == IMP_ERROR_PLUGIN) return code;
        if (code != IMP_SUCCESS) *state = IMPACT_NO_MEMORY;
    }
    return IMP_SUCCESS;
}

imp_code split_leave_out_halves(impact *im, pair *p, net_halves *halves, bool *some,
                                imp_error *error)
{
    const candidate_pair *both = impact_candidates(im, p);
    halves->has_heights = false;
    *some = true;
    if (!strategy_has_both_hulls(p->a, p->b)) return IMP_SUCCESS;
    net_halves_find(p->a, p->b, p->axis, im->gamma_clear, &p->window, halves);
    const int count = halves->count;
    *some = count == 0 || halves->found[count - 1].half >= 0;
    if (count == 0 || !*some) return IMP_SUCCESS;
    p->wait -= p->wait < (uint32_t)count ? p->wait : (uint32_t)count;
    const imp_code code = pair_take_halves(p, halves->found, count, both, im->stats, error);
    for (int k = 0; k < count && code == IMP_SUCCESS; ++k) {
        const net_half *h = &halves->found[k];
        pair_note_cut(im->proof, p, &(cut){h->side, h->along, 0}, h->half);
        pair_note_test(im->proof, p, true);
    }
    return code == IMP_SUCCESS ? pair_test_ask_for_nets(im, p, &im->stats->bytes, error) : code;
}
