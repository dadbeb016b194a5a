/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/pair_test.h"

#include <stdlib.h>

#include "core/bounds/moving_boxes.h"
#include "core/bounds/separation.h"
#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "core/broad_phase/parallel.h"
#include "core/solver/pair_meeting.h"

static bool test_by_paper(const impact *im, const pair *p)
{
    return (im->baseline & IMP_BASELINE_BOXES) != 0
               ? !separation_of_boxes(p->a, p->b, im->gamma_clear)
               : !separation_of_balls(p->a, p->b, im->gamma_clear);
}

bool pair_test_fully(const impact *im, pair *p)
{
    if (im->baseline != IMP_BASELINE_NONE) return test_by_paper(im, p);
    p->is_seen_only = false;
    return separation_window(p->a, p->b, im->gamma_clear, &p->window, &p->axis,
                             impact_turning(im, p)) &&
           pair_spread_cut(im, p);
}

/* --- The first test --------------------------------------------------------------------------- */

/* Later tests of the pair use the nets that are made here (node_net_made). */
imp_code pair_test_make_nets(const impact *im, const pair *p, const bool sides[2], uint64_t *bytes,
                             imp_error *error)
{
    const candidate_pair *both = &im->candidate_pairs[p->candidate_pair];
    node *const nodes[2] = {p->a, p->b};
    tree_growth growth = {0};
    imp_code code = IMP_SUCCESS;
    for (int side = 0; side < 2 && code == IMP_SUCCESS; ++side) {
        const net *found;
        if (sides[side])
            code = node_net(both->side[side]->tree, nodes[side], &found, &growth, error);
    }
    *bytes += growth.bytes;
    return code;
}

imp_code pair_test_ask_for_nets(const impact *im, const pair *p, uint64_t *bytes, imp_error *error)
{
    if (im->baseline != IMP_BASELINE_NONE) return IMP_SUCCESS;
    if (node_net_is_asked(p->a) && node_net_is_asked(p->b)) return IMP_SUCCESS;
    if (!strategy_wants_nets(p->a, p->b)) return IMP_SUCCESS;
    const bool offers[2] = {surface_offers_net(p->a->surface), surface_offers_net(p->b->surface)};
    return pair_test_make_nets(im, p, offers, bytes, error);
}

imp_code pair_test_first(const impact *im, pair_test *t, trial_rate *turning, imp_error *error)
{
    pair *p = &t->p;
    const bool waits = im->baseline == IMP_BASELINE_NONE && !(vec3_norm1(p->axis) > 0) &&
                       strategy_waits_for_nets(p->a, p->b);
    if (waits) {
        p->is_seen_only = p->lacks_nets = true;
        t->near =
            separation_without_nets(p->a, p->b, im->gamma_clear, &p->window, &p->axis, turning);
        return IMP_SUCCESS;
    }
    const imp_code code = pair_test_ask_for_nets(im, &t->p, &t->bytes, error);
    if (code != IMP_SUCCESS) return code;
    t->near = im->baseline != IMP_BASELINE_NONE
                  ? test_by_paper(im, &t->p)
                  : separation_first_look(t->p.a, t->p.b, im->gamma_clear, &t->p.window, &t->p.axis,
                                          turning, &t->p.is_seen_only);
    if (t->near && !t->p.is_seen_only) t->near = pair_spread_cut(im, &t->p);
    return IMP_SUCCESS;
}

/* --- Candidate pairs -------------------------------------------------------------------------- */

/* Whether its two bodies have many candidate pairs, which are neighbours in the list: few of them
 * will be popped. Other bodies do not matter, so that a query of the two alone finds the same
 * contact. */
static bool is_of_many(const impact *im, size_t index)
{
    const size_t apart = TUNING_GLANCES_APART;
    const candidate_pair *both = &im->candidate_pairs[index];
    if (im->baseline != IMP_BASELINE_NONE) return false;
    return (index >= apart && candidate_pairs_same_bodies(both - apart, both)) ||
           (index + apart < im->candidate_pair_count &&
            candidate_pairs_same_bodies(both + apart, both));
}

static imp_code test_roots_fully(const impact *im, pair_test *t, imp_error *error)
{
    bool met;
    const imp_code code = pair_meeting_seek(im, t, &met, error);
    return code != IMP_SUCCESS || met ? code : pair_test_first(im, t, NULL, error);
}

static imp_code test_roots(const impact *im, uint32_t index, pair_test *t, imp_error *error)
{
    const candidate_pair *both = &im->candidate_pairs[index];
    *t = (pair_test){.p = {.a = tree_root(both->side[0]->tree),
                           .b = tree_root(both->side[1]->tree),
                           .candidate_pair = index,
                           .tubes = TUBES_WHOLE,
                           .proof = index}};
    t->p.window = window_common(im->window, pair_times(t->p.a, t->p.b));
    t->any_time = t->p.window.lo <= t->p.window.hi;
    if (!t->any_time) return IMP_SUCCESS;
    if (!is_of_many(im, index)) return test_roots_fully(im, t, error);
    t->near = moving_boxes_cut(t->p.a, t->p.b, im->gamma_clear, &t->p.window);
    t->p.is_seen_only = t->p.lacks_nets = true;
    return IMP_SUCCESS;
}

imp_code pair_test_candidate(impact *im, uint32_t index, pair_test *t, imp_error *error)
{
    const bool is_ahead = index - im->ahead.first < im->ahead.count;
    if (!is_ahead) return test_roots(im, index, t, error);
    *t = im->ahead.tests[index - im->ahead.first];
    return t->done ? IMP_SUCCESS : test_roots(im, index, t, error);
}

/* Whether its test makes no net. Nets made ahead by threads could make a memory limit end the
 * search at another step. */
static bool makes_no_net(const impact *im, size_t index)
{
    const candidate_pair *both = &im->candidate_pairs[index];
    if (im->baseline != IMP_BASELINE_NONE || is_of_many(im, index)) return true;
    for (int side = 0; side < 2; ++side) {
        const node *root = tree_root(both->side[side]->tree);
        if (surface_offers_net(root->surface) && !node_net_is_asked(root)) return false;
    }
    return true;
}

enum { TESTS_A_TASK = 64, TASKS_A_ROUND = 64, TESTS_A_ROUND = TESTS_A_TASK * TASKS_A_ROUND };

static void test_some(void *of, size_t task)
{
    impact *im = of;
    const tests_ahead *ahead = &im->ahead;
    for (size_t k = task * TESTS_A_TASK; k < ahead->count && k < (task + 1) * TESTS_A_TASK; ++k) {
        pair_test *t = &ahead->tests[k];
        const uint32_t index = ahead->first + (uint32_t)k;
        t->done = makes_no_net(im, index) && test_roots(im, index, t, NULL) == IMP_SUCCESS;
    }
}

void pair_test_look_ahead(impact *im, uint32_t first, size_t count, const imp_options *options)
{
    tests_ahead *ahead = &im->ahead;
    if (!parallel_is_on(options) || first - ahead->first < ahead->count) return;
    if (ahead->tests == NULL)
        ahead->tests = arena_store_room(im->heap.store, TESTS_A_ROUND * sizeof *ahead->tests);
    if (ahead->tests == NULL) return;
    ahead->first = first;
    ahead->count = count - first < TESTS_A_ROUND ? (uint32_t)(count - first) : TESTS_A_ROUND;
    for (uint32_t k = 0; k < ahead->count; ++k) ahead->tests[k] = (pair_test){.done = false};
    parallel_run(options, test_some, im, (ahead->count + TESTS_A_TASK - 1) / TESTS_A_TASK);
}
