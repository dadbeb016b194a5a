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
 * place or at another that was popped before; where one side has no line; or if they have taken
 * long, where surfaces touch all along a curve. */
static void open_if_due(pair_trials *trials, pair *p)
{
    trials->tubes += 1;
    if (!pair_has_tubes(p) || tubes_cross(p) || trials->tubes >= (uint32_t)TUNING_TUBES_MOST)
        trials->are_open = true;
    if (trials->are_open) p->tubes = TUBES_OPEN;
}

/* Points of a line, and how far the surface is from each. */
enum { LINE_POINTS = 8 };
typedef struct line_points {
    vec3 x[LINE_POINTS];
    double radius[LINE_POINTS];
} line_points;

/* False: there is no line everywhere. */
static bool find_line(const surface *s, double t, line_points *line)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    const double first = lo[PARAMETER_U], step = (hi[PARAMETER_U] - first) / LINE_POINTS;
    lo[PARAMETER_T] = hi[PARAMETER_T] = t;
    for (int k = 0; k < LINE_POINTS; ++k) {
        imp_tube tube;
        lo[PARAMETER_U] = hi[PARAMETER_U] = first + (k + 0.5) * step;
        const imp_region at = region_make(lo, hi);
        if (surface_tube(s, &at, &tube) != IMP_STATUS_OK) return false;
        for (int i = 0; i < 3; ++i) line->x[k].x[i] = tube.line[i].a;
        line->radius[k] = tube.radius;
    }
    return surface_move_outward(s, 0, t, LINE_POINTS, line->x[0].x) == IMP_STATUS_OK;
}

/* Whether the tubes are seen to cross at the window's start, as those of surfaces of which one is
 * inside of the other. More points see more, but cost: each takes some 3,000 instructions. */
static bool lines_cross(const pair *p)
{
    line_points a, b;
    bool cross = false;
    if (!find_line(p->a->surface, p->window.lo, &a)) return false;
    if (!find_line(p->b->surface, p->window.lo, &b)) return false;
    for (int j = 0; j < LINE_POINTS; ++j)
        for (int k = 0; k < LINE_POINTS; ++k) {
            const vec3 apart = vec3_sub(a.x[j], b.x[k]);
            const double both = a.radius[j] + b.radius[k];
            cross = cross || vec3_dot(apart, apart) < both * both;
        }
    return cross;
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
    if (p->tubes == TUBES_CLOSED) open_if_due(&im->trials[p->candidate_pair], p);
    if (!is_whole) return IMP_SUCCESS;
    p->tubes = TUBES_NONE;
    if (!is_to_be_tube(p->a) || !is_to_be_tube(p->b)) return IMP_SUCCESS;
    if (im->trials == NULL || im->proof != NULL || im->spread != NULL) return IMP_SUCCESS;
    if (impact_is_narrow(im)) return IMP_SUCCESS;
    /* In a half plane surfaces count as curves already. */
    if (impact_candidates(im, p)->side[0]->half != NULL) return IMP_SUCCESS;
    pair_trials *trials = &im->trials[p->candidate_pair];
    trials->are_open = trials->are_open || lines_cross(p);
    return trials->are_open ? IMP_SUCCESS : take_tubes(im, p, error);
}

imp_code pair_tubes_take(const impact *im, pair *p, double *gamma, imp_error *error)
{
    const imp_code code = take(im, p, error);
    if (p->tubes == TUBES_CLOSED) *gamma = sum_upper(*gamma, sum_upper(p->a->ball, p->b->ball));
    return code;
}

static bool can_be_cut_around(const node *n)
{
    return n->ball > 0 && region_can_split(&n->region, PARAMETER_V);
}

bool pair_tubes_open(const impact *im, pair *p)
{
    if (!can_be_cut_around(p->a) && !can_be_cut_around(p->b)) return false;
    im->trials[p->candidate_pair].are_open = true;
    p->tubes = TUBES_OPEN;
    return true;
}
