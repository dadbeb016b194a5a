/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/explanation.h"

#include <stddef.h>
#include <string.h>

#include "core/bounds/strategy.h"
#include "core/surface/region.h"

/* --- Variants of a pair ----------------------------------------------------------------------- */

/* Copies a node without its net and children, which other threads may be making; `exact`: also
 * without its remainder. */
static node twin_of(const node *n, bool exact)
{
    node twin = {.surface = NULL};
    memcpy(&twin, n, offsetof(node, net));
    twin.ball = n->ball;
    if (exact) {
        memset(twin.e, 0, sizeof twin.e);
        return twin;
    }
    twin.shape = n->shape;
    twin.span = n->span;
    twin.still = n->still;
    twin.pose = n->pose;
    memcpy(twin.posed_e, n->posed_e, sizeof twin.posed_e);
    return twin;
}

/* Returns the length of the part of the pair's window that quadratics leave of it; negative: they
 * part the pair. */
static double left_of(const pair *p, bool exact_a, bool exact_b, double gamma_clear)
{
    const node a = twin_of(p->a, exact_a), b = twin_of(p->b, exact_b);
    time_window window = p->window;
    vec3 axis = p->axis;
    trial_rate turning = {0};
    if (!separation_without_nets(&a, &b, gamma_clear, &window, &axis, &turning)) return -1;
    return window.hi - window.lo;
}

/* A variant helps if it parts the pair or leaves less than half of the window. */
static bool helps(double left, double before) { return left < 0 || left < 0.5 * before; }

/* --- Remainders ------------------------------------------------------------------------------- */

static imp_obstacle remainder_obstacle(const pair *p, int side)
{
    const node *n = side == 0 ? p->a : p->b;
    const bool is_of_time = n->time_remainder > 0.5 * node_blurs_sum(n);
    if (side == 0) return is_of_time ? IMP_OBSTACLE_TIME_A : IMP_OBSTACLE_REMAINDER_A;
    return is_of_time ? IMP_OBSTACLE_TIME_B : IMP_OBSTACLE_REMAINDER_B;
}

/* Returns the side whose remainder holds the pair together, -1: none, since the quadratics alone
 * come near each other. */
static int blurred_side(const pair *p, double gamma_clear)
{
    const double whole = p->window.hi - p->window.lo;
    const double now = left_of(p, false, false, gamma_clear);
    const double before = now >= 0 && now < whole ? now : whole;
    const int larger = node_blurs_sum(p->b) > node_blurs_sum(p->a);
    double left[2];
    left[0] = left_of(p, true, false, gamma_clear);
    left[1] = left_of(p, false, true, gamma_clear);
    if (helps(left[larger], before)) return larger;
    if (helps(left[!larger], before)) return !larger;
    return helps(left_of(p, true, true, gamma_clear), before) ? larger : -1;
}

/* --- Distances -------------------------------------------------------------------------------- */

/* Estimates the curvature of a node along a unit vector: the second derivative by length. */
static double curvature_along(const node *n, const vec3 *unit)
{
    double bend = 0, length = 0;
    for (int i = 0; i < 3; ++i) {
        bend += 2 * (n->f.quu[i] + n->f.qvv[i]) * unit->x[i];
        length += n->f.bu[i] * n->f.bu[i] + n->f.bv[i] * n->f.bv[i];
    }
    return length > 0 ? bend / length : 0;
}

/* Whether the surfaces lie along each other, bent to the same side: a convex one in a hollow. Nodes
 * of each then have many neighbours that only a distance parts at once. */
static bool lie_along(const pair *p)
{
    if (!strategy_is_tangent(p->a, p->b)) return false;
    const vec3 normal = node_normal(p->a);
    const double length = vec3_norm(normal);
    if (!(length > 0)) return false;
    const vec3 unit = vec3_scale(normal, 1 / length);
    const double a = curvature_along(p->a, &unit), b = curvature_along(p->b, &unit);
    return a * b > 0 && fabs(a - b) < 0.5 * fmax(fabs(a), fabs(b));
}

/* Whether the type bounds distances from this instance, which it may for some alone: tried at a
 * point of the surface. */
static bool knows_distance(const candidate *c)
{
    const node *root = tree_root(c->tree);
    imp_model point[3], distance;
    if (!surface_has_distance(root->surface)) return false;
    if (root->many != NULL) return true;
    const imp_region middle = region_make(root->region.c, root->region.c);
    return surface_include_bare(root->surface, &middle, point) == IMP_STATUS_OK &&
           surface_distance(root->surface, &middle, 0, point, &distance) == IMP_STATUS_OK;
}

/* --- One pair --------------------------------------------------------------------------------- */

imp_obstacle explanation_of(const pair *p, const candidate_pair *both, double gamma_clear)
{
    if (!p->a->bounded) return IMP_OBSTACLE_BOUNDS_A;
    if (!p->b->bounded) return IMP_OBSTACLE_BOUNDS_B;
    if (pair_has_cluster(p)) return IMP_OBSTACLE_SIZE;
    const int side = blurred_side(p, gamma_clear);
    if (side >= 0) return remainder_obstacle(p, side);
    const bool lacks_distance = !knows_distance(both->side[0]) && !knows_distance(both->side[1]);
    return lacks_distance && lie_along(p) ? IMP_OBSTACLE_DISTANCE : IMP_OBSTACLE_SIZE;
}

imp_obstacle explanation_if_asked(const impact *im, const pair *p)
{
    if (im->explained == NULL) return IMP_OBSTACLE_SIZE;
    return explanation_of(p, &im->candidate_pairs[p->candidate_pair], im->gamma_clear);
}

void explanation_count(impact *im, const pair *p, imp_obstacle obstacle)
{
    if (im->explained == NULL) return;
    im->explained[p->candidate_pair].divided += 1;
    im->explained[p->candidate_pair].by[obstacle] += 1;
}

/* --- What types leave out --------------------------------------------------------------------- */

/* Returns the name of the first type or map without inclusions, or NULL. */
static const char *without_order_2(const surface *s)
{
    surface_instance found;
    for (size_t k = 0; surface_instance_at(s, k, &found); ++k)
        if (!found.has_order_2) return found.name;
    return NULL;
}

void explanation_describe(const candidate_pair *both, imp_explanation *row)
{
    for (int side = 0; side < 2; ++side) {
        const candidate *c = both->side[side];
        const surface *s = tree_surface(c->tree);
        surface_instance type;
        row->body[side] = c->body;
        row->surface[side] = c->surface;
        row->type[side] = surface_instance_at(s, 0, &type) ? type.name : NULL;
        row->without_order_2[side] = without_order_2(s);
        row->knows_distance[side] = knows_distance(c);
    }
}
