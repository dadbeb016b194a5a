/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "time_of_impact.h"

#include <assert.h>

/* --- Test and push ---------------------------------------------------------------- */

static bool pair_may_be_near(const impact *im, pair *p)
{
    if (im->method == IMP_METHOD_PAPER)
        return im->bounds == IMP_BOUNDS_BOX ? !separation_of_boxes(p->a, p->b, im->clearance)
                                            : !separation_of_balls(p->a, p->b, im->clearance);
    return separation_by_models(p->a, p->b, im->clearance, &p->window, &p->axis);
}

/* The second key, among pairs of the same start: the squared distance of the centres. Where a node
 * has no bounds the pair comes behind all others, the last made first, so that a place that has
 * none down to the smallest region is come to without going through all of its surroundings. */
static double pair_order(const pair *p)
{
    if (!p->a->bounded || !p->b->bounded) return 0x1p900 * (0x1p53 - (double)p->serial);
    const double distance2 = separation_centres(p->a, p->b, p->window.lo);
    return distance2 >= 0 ? distance2 : INFINITY;
}

/* Puts the pair of p's nodes on the heap, which has room, unless they stay apart. p->window holds
 * the parent's window and is cut to both nodes' times first. */
static void test_and_push(impact *im, pair p)
{
    const imp_region *a = &p.a->region, *b = &p.b->region;
    if (a->lo[2] > p.window.lo) p.window.lo = a->lo[2];
    if (b->lo[2] > p.window.lo) p.window.lo = b->lo[2];
    if (a->hi[2] < p.window.hi) p.window.hi = a->hi[2];
    if (b->hi[2] < p.window.hi) p.window.hi = b->hi[2];
    if (p.window.lo > p.window.hi) return;
    im->stats.pairs += 1;
    if (!pair_may_be_near(im, &p)) return;
    p.serial = im->serial++;
    p.distance2 = pair_order(&p);
    pair_heap_push(&im->heap, &p);
    if (im->heap.count > im->stats.peak_heap) im->stats.peak_heap = im->heap.count;
}

/* Looks at the middles of both at the ends and in the middle of the window: the largest error of
 * the gap. */
static imp_code measure_inexact(couple *both, const time_window *window, imp_error *error)
{
    const tree *const trees[2] = {both->trees[0], both->trees[1]};
    const node *const nodes[2] = {tree_root(trees[0]), tree_root(trees[1])};
    const double times[3] = {window->lo, 0.5 * window->lo + 0.5 * window->hi, window->hi};
    both->inexact = 0;
    for (int k = 0; k < 3; ++k) {
        witness seen;
        const imp_code code = witness_at_centres(trees, nodes, times[k], &seen, error);
        if (code != IMP_SUCCESS) return code;
        const double inexact = seen.gap_upper - seen.gap;
        if (inexact > both->inexact) both->inexact = inexact;
    }
    return IMP_SUCCESS;
}

imp_code impact_add_couple(impact *im, uint32_t index, impact_state *state, imp_error *error)
{
    couple *both = &im->couples[index];
    const size_t before = im->heap.count;
    const pair p = {.window = {-INFINITY, INFINITY},
                    .a = tree_root(both->trees[0]),
                    .b = tree_root(both->trees[1]),
                    .couple = index};
    *state = IMPACT_NO_MEMORY;
    if (!pair_heap_reserve(&im->heap, 1)) return IMP_SUCCESS;
    *state = IMPACT_RUNNING;
    test_and_push(im, p);
    if (im->heap.count == before) return IMP_SUCCESS;
    const imp_region *a = &p.a->region, *b = &p.b->region;
    const time_window common = {a->lo[2] > b->lo[2] ? a->lo[2] : b->lo[2],
                                a->hi[2] < b->hi[2] ? a->hi[2] : b->hi[2]};
    return measure_inexact(both, &common, error);
}

static couple *couple_of(const impact *im, const pair *p) { return &im->couples[p->couple]; }

static const node *side_of(const pair *p, int side) { return side == 0 ? p->a : p->b; }

/* Of both surfaces, at any one time. */
static double pair_curvature(const pair *p)
{
    double sum = 0;
    for (int side = 0; side < 2; ++side) {
        const quadratic3 *f = &side_of(p, side)->f;
        for (int i = 0; i < 3; ++i) sum += fabs(f->quu[i]) + fabs(f->quv[i]) + fabs(f->qvv[i]);
    }
    return sum;
}

static double pair_remainder(const pair *p)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += p->a->e[i] + p->b->e[i];
    return sum;
}

static double pair_extent(const pair *p)
{
    return p->a->spread[0] + p->a->spread[1] + p->b->spread[0] + p->b->spread[1];
}

/* --- Splitting ------------------------------------------------------------------------ */

typedef struct cut {
    int side; /* 0: a, 1: b; -1: nothing left to split */
    parameter along;
    double gain;
} cut;

/* Beside a node without bounds nothing is learnt from cutting one that has them. */
static void cut_consider(cut *best, const pair *p, int side, parameter j, double gain)
{
    if (side_of(p, side)->bounded && !side_of(p, !side)->bounded) return;
    if (!region_can_split(&side_of(p, side)->region, j)) return;
    if (best->side < 0 || gain > best->gain) *best = (cut){side, j, gain};
}

/* The paper: the parameter of either node that contributes most to its box. */
static cut cut_by_contribution(const pair *p)
{
    cut best = {-1, PARAMETER_U, 0};
    for (int side = 0; side < 2; ++side)
        for (int j = 0; j < 3; ++j)
            cut_consider(&best, p, side, (parameter)j, side_of(p, side)->spread[j]);
    return best;
}

/* Whether the half below (0) or above (1) a cut in time holds moments of the window that the other
 * does not. Of a window that touches the cut with its end one half holds all, so that no pair is
 * left with a single moment which its neighbours in time look at too. */
static bool half_is_needed(const time_window *window, double at, int half)
{
    if (window->lo >= at) return half == 1;
    if (window->hi <= at) return half == 0;
    return true;
}

/* Then a cut in time is free. */
static bool is_one_half_enough(const time_window *window, double at)
{
    return !half_is_needed(window, at, 0) || !half_is_needed(window, at, 1);
}

/* Whether time blurs the node enough to count beside gamma, and beside what u and v blur of both.
 */
static bool time_blurs(const impact *im, const pair *p, const node *n)
{
    const double place = pair_remainder(p) - (p->a->unsteady + p->b->unsteady);
    return 64 * n->unsteady > im->gamma && 4 * n->unsteady > place;
}

/* What a cut in time is worth, on the scale of the spread. Linear motion costs nothing, so only
 * what bends counts; more where the cut is free, and most where it is and time blurs the node. */
static double gain_in_time(const impact *im, const pair *p, const node *n)
{
    if (!is_one_half_enough(&p->window, n->region.c[PARAMETER_T])) return 2 * n->bend[PARAMETER_T];
    return time_blurs(im, p, n) ? INFINITY : 8 * n->bend[PARAMETER_T];
}

/* Models: what moves a point most along u or v, or bends it in time. */
static cut cut_by_spread(const impact *im, const pair *p)
{
    cut best = {-1, PARAMETER_U, 0};
    for (int side = 0; side < 2; ++side) {
        const node *n = side_of(p, side);
        cut_consider(&best, p, side, PARAMETER_U, n->spread[0]);
        cut_consider(&best, p, side, PARAMETER_V, n->spread[1]);
        cut_consider(&best, p, side, PARAMETER_T, gain_in_time(im, p, n));
    }
    return best;
}

/* Nothing more to learn from u and v: the later of the two nodes' times is halved. */
static cut cut_in_time(const pair *p)
{
    cut best = {-1, PARAMETER_T, 0};
    for (int side = 0; side < 2; ++side)
        cut_consider(&best, p, side, PARAMETER_T, side_of(p, side)->region.d[PARAMETER_T]);
    return best;
}

/* node_child, counted. */
static imp_code child_of(impact *im, tree *t, node *parent, parameter j, int half, node **child,
                         imp_error *error)
{
    const uint64_t nodes = tree_node_count(t);
    const size_t bytes = tree_bytes(t);
    const imp_code code = node_child(t, parent, j, half, child, error);
    im->stats.nodes += tree_node_count(t) - nodes;
    im->stats.bytes += tree_bytes(t) - bytes;
    return code;
}

static imp_code split(impact *im, const pair *p, cut c, impact_state *state, imp_error *error)
{
    couple *both = couple_of(im, p);
    for (int half = 0; half < 2; ++half) {
        pair child = *p;
        node **slot = c.side == 0 ? &child.a : &child.b;
        const double at = (*slot)->region.c[c.along];
        if (c.along == PARAMETER_T && !half_is_needed(&p->window, at, half)) continue;
        const imp_code code = child_of(im, both->trees[c.side], *slot, c.along, half, slot, error);
        if (code == IMP_ERROR_PLUGIN) return code;
        if (code == IMP_SUCCESS)
            test_and_push(im, child);
        else
            *state = IMPACT_NO_MEMORY;
    }
    return IMP_SUCCESS;
}

/* --- Following one pair ------------------------------------------------------------------ */

static imp_code look(impact *im, const pair *p, bool moving, witness *seen, imp_error *error)
{
    const couple *both = couple_of(im, p);
    const tree *const trees[2] = {both->trees[0], both->trees[1]};
    const node *const nodes[2] = {p->a, p->b};
    im->stats.witness_searches += 1;
    return moving ? witness_seek(trees, nodes, p->window.lo, im->gamma, seen, error)
                  : witness_at_centres(trees, nodes, p->window.lo, seen, error);
}

static impact_state contact(impact *im, const pair *p, const witness *seen)
{
    im->found = *seen;
    im->found_couple = p->couple;
    return IMPACT_CONTACT;
}

/* The paper's Figure 6: a pair whose volumes are within gamma of each other altogether (eq. 6) is a
 * collision; any other is subdivided. */
static imp_code follow_paper(impact *im, const pair *p, impact_state *state, imp_error *error)
{
    const double farthest = im->bounds == IMP_BOUNDS_BOX ? separation_farthest_of_boxes(p->a, p->b)
                                                         : separation_farthest_of_balls(p->a, p->b);
    if (farthest <= im->gamma) {
        witness seen;
        const imp_code code = look(im, p, false, &seen, error);
        if (code != IMP_SUCCESS) return code;
        *state = seen.gap_upper <= im->gamma ? contact(im, p, &seen) : IMPACT_RESOLUTION;
        return IMP_SUCCESS;
    }
    const cut c = cut_by_contribution(p);
    if (c.side >= 0) return split(im, p, c, state, error);
    *state = IMPACT_RESOLUTION;
    return IMP_SUCCESS;
}

enum {
    WITNESS_WAIT = 5
}; /* generations between searches: halves the pair's four sides about once */

/* Whether rounding takes much of the room between clearance and gamma, and the pair is as flat as
 * `flat` times the rounding: then splitting on teaches ever less and only multiplies pairs. */
static bool precision_ends(const impact *im, const pair *p, double flat)
{
    const double inexact = couple_of(im, p)->inexact;
    return 16 * inexact >= im->gamma - im->clearance && pair_curvature(p) <= flat * inexact &&
           pair_remainder(p) <= 64 * flat * inexact;
}

/* Whether a search may pay: the polynomials are good enough for gamma, or all that there will ever
 * be. */
static bool witness_is_likely(const impact *im, const pair *p)
{
    if (p->wait > 0) return false;
    const double remainder = pair_remainder(p);
    return 2 * remainder <= im->gamma || 4 * pair_extent(p) <= remainder ||
           precision_ends(im, p, 16);
}

static imp_code follow_models(impact *im, pair *p, impact_state *state, imp_error *error)
{
    if (witness_is_likely(im, p)) {
        witness seen;
        const imp_code code = look(im, p, true, &seen, error);
        if (code != IMP_SUCCESS) return code;
        if (seen.gap_upper <= im->gamma)
            *state = contact(im, p, &seen);
        else if (precision_ends(im, p, 1))
            *state = IMPACT_RESOLUTION;
        if (*state != IMPACT_RUNNING) return IMP_SUCCESS;
        p->wait = WITNESS_WAIT;
    } else if (p->wait > 0) {
        p->wait -= 1;
    }
    const bool tiny = 64 * pair_extent(p) <= im->gamma - im->clearance;
    const cut c = tiny ? cut_in_time(p) : cut_by_spread(im, p);
    if (c.side >= 0) return split(im, p, c, state, error);
    *state = IMPACT_RESOLUTION;
    return IMP_SUCCESS;
}

/* Lemma. The popped pair's window starts first of all, and outside the windows on the heap no two
 * points are within the clearance: so nothing is before that start. Children's windows lie in their
 * parent's, so the bound never falls. A pair that ends the search goes back: finer gamma can go on
 * from it. */
imp_code impact_advance(impact *im, impact_state *state, imp_error *error)
{
    *state = IMPACT_CLEAR;
    if (im->heap.count == 0) return IMP_SUCCESS;
    *state = IMPACT_NO_MEMORY;
    if (!pair_heap_reserve(&im->heap, 1)) return IMP_SUCCESS; /* and the place of the one popped */
    *state = IMPACT_RUNNING;
    pair p = pair_heap_pop(&im->heap);
    if (p.window.lo > im->t_lower) im->t_lower = p.window.lo;
    pair followed = p;
    const imp_code code = im->method == IMP_METHOD_PAPER
                              ? follow_paper(im, &followed, state, error)
                              : follow_models(im, &followed, state, error);
    if (code != IMP_SUCCESS || *state != IMPACT_RUNNING) pair_heap_push(&im->heap, &p);
    return code;
}

void impact_clear(impact *im) { pair_heap_clear(&im->heap); }
