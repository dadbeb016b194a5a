/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>

#include "core/base/rounding.h"
#include "core/bounds/separation.h"
#include "core/bounds/spine.h"
#include "core/tree/node_model.h"

/* --- Over one span of time -------------------------------------------------------------------- */

/* A length that no distance matters beyond. */
#define MUCH 0x1p100

/* What a spine is compared with. */
typedef enum spine_goal { OTHER_SPINE, OTHER_SURFACE, OTHER_PIECES } spine_goal;

/* The most pieces that are compared with a spine one by one, and comparisons in all. */
enum { PIECES_COMPARED = 128, LOOKS_MOST = 8192 };

typedef struct spine_query {
    const distance_sides *of;
    time_window times;
    spine line[2];
    bool has[2];
    int side; /* whose spine it is */
    spine_goal goal;
    double most;  /* greater distances do not matter, beside radii; length */
    size_t looks; /* comparisons */
    imp_error *error;
} spine_query;

/* A bound of the distance of two nodes over a span that is no greater than `most`. */
static double apart(const node *a, const node *b, double from, double to, double most)
{
    time_window window = {from, to};
    vec3 axis = {{0, 0, 0}};
    approach near = {0, 0.5 * from + 0.5 * to};
    const bool some = separation_approach(a, b, most, &window, &axis, &near);
    return some && !(near.lower >= most) ? near.lower : most;
}

static imp_code from_surface(spine_query *q, const imp_region *r, const imp_model x[3], double most,
                             double *lower)
{
    const surface *other = q->of->root[!q->side]->surface;
    time_window window = {r->lo[2], r->hi[2]};
    imp_model g;
    const imp_status status = surface_distance(other, r, surface_map_count(other), x, &g);
    q->looks += 1;
    *lower = 0;
    if (status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    if (status != IMP_STATUS_OK) return distance_fault(other, status, q->error);
    if (distance_cut_heights(&g, 2, r, most, &window, lower) || *lower > most) *lower = most;
    return IMP_SUCCESS;
}

static imp_code from_pieces(spine_query *q, const node *own, double most, double *lower)
{
    const surface *other = q->of->root[!q->side]->surface;
    const size_t parts = surface_part_count(other);
    const imp_region *r = &own->region;
    *lower = most;
    for (size_t k = 0; k<parts && * lower> 0; ++k) {
        const surface *piece = surface_part(other, k);
        node n = {.surface = piece};
        double lo[3], hi[3];
        imp_model x[3];
        surface_domain(piece, lo, hi);
        lo[2] = r->lo[2], hi[2] = r->hi[2];
        region_set(&n.region, lo, hi);
        const imp_status status = surface_include(piece, &n.region, x);
        q->looks += 1;
        if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED)
            return distance_fault(piece, status, q->error);
        const bool known =
            status == IMP_STATUS_OK && node_take_model(&n, x, true) == NULL && n.bounded;
        *lower = known ? apart(own, &n, r->lo[2], r->hi[2], *lower) : 0;
    }
    return IMP_SUCCESS;
}

/* Lemma. Each point of a surface is within the radius of its spine, at each time, since its last
 * maps keep lengths. So two surfaces are no nearer than the one's spine is to the other surface, or
 * to its spine, less the radius or radii. */
static imp_code look(spine_query *q, double from, double to, double *lower)
{
    const spine *own = &q->line[q->side], *other = &q->line[!q->side];
    const bool both = q->goal == OTHER_SPINE;
    const double radius = both ? sum_upper(own->radius, other->radius) : own->radius;
    const double most = sum_upper(radius, q->most);
    imp_model x[3], y[3];
    node a, b;
    imp_code code = IMP_SUCCESS;
    double found = 0;
    *lower = 0;
    if (!spine_node(own, from, to, x, &a)) return IMP_SUCCESS;
    if (q->goal == OTHER_SURFACE)
        code = from_surface(q, &a.region, x, most, &found);
    else if (q->goal == OTHER_PIECES)
        code = from_pieces(q, &a, most, &found);
    else if (spine_node(other, from, to, y, &b))
        q->looks += 1, found = apart(&a, &b, from, to, most);
    if (found > radius) *lower = difference_lower(found, radius);
    return code;
}

/* --- Which comparison may do ------------------------------------------------------------------ */

static bool is_offered(const spine_query *q)
{
    const node *other = q->of->root[!q->side];
    if (!q->has[q->side]) return false;
    if (q->goal == OTHER_SPINE) return q->side == 0 && q->has[1];
    if (q->goal == OTHER_SURFACE)
        return other->many == NULL && surface_has_distance(other->surface);
    return surface_part_count(other->surface) <= PIECES_COMPARED;
}

/* Whether it shows more than the limit at some moments, with a radius that may be too small. */
static imp_code try_moments(spine_query *q, double limit, double *least)
{
    static const double parts[] = {0.5, 0, 1, 0.23, 0.81};
    *least = INFINITY;
    for (int k = 0; k < 5 && *least > limit; ++k) {
        const double t = (1 - parts[k]) * q->times.lo + parts[k] * q->times.hi;
        double lower;
        const imp_code code = look(q, t, t, &lower);
        if (code != IMP_SUCCESS) return code;
        if (lower < *least) *least = lower;
    }
    return IMP_SUCCESS;
}

/* *hope becomes the most that one of them shows. */
static imp_code choose(spine_query *q, double limit, double *least, double *hope)
{
    static const spine_goal goals[] = {OTHER_SPINE, OTHER_SURFACE, OTHER_PIECES};
    q->most = MUCH;
    for (int k = 0; k < 3; ++k)
        for (q->side = 0; q->side < 2; ++q->side) {
            q->goal = goals[k];
            if (!is_offered(q)) continue;
            const imp_code code = try_moments(q, limit, least);
            if (*least > *hope) *hope = *least;
            if (code != IMP_SUCCESS || *least > limit) return code;
        }
    return *least = 0, IMP_SUCCESS;
}

/* --- Over all times --------------------------------------------------------------------------- */

enum { SPANS = 256 };

/* Spans shorter than this part of all times are not halved: where surfaces come to touch, the least
 * bound stays at one moment, however short its span. */
#define SHORTEST 0x1p-20

/* Spans of time, one after the other, with their bounds. */
typedef struct spans {
    double from[SPANS + 1], lower[SPANS];
    size_t count;
} spans;

static size_t lowest(const spans *s)
{
    size_t best = 0;
    for (size_t k = 1; k < s->count; ++k)
        if (!(s->lower[k] >= s->lower[best])) best = k;
    return best;
}

static imp_code halve(spine_query *q, spans *s, size_t k)
{
    const double middle = 0.5 * s->from[k] + 0.5 * s->from[k + 1];
    imp_code code = IMP_SUCCESS;
    for (size_t j = s->count + 1; j > k + 1; --j) s->from[j] = s->from[j - 1];
    for (size_t j = s->count; j > k + 1; --j) s->lower[j] = s->lower[j - 1];
    s->from[k + 1] = middle;
    s->count += 1;
    for (size_t j = k; j < k + 2 && code == IMP_SUCCESS; ++j)
        code = look(q, s->from[j], s->from[j + 1], &s->lower[j]);
    return code;
}

/* Halves the span of the least bound until that is enough. */
static imp_code bound_all(spine_query *q, double enough, double *lower)
{
    spans s = {.from = {q->times.lo, q->times.hi}, .count = 1};
    imp_code code = look(q, q->times.lo, q->times.hi, &s.lower[0]);
    size_t k = 0;
    const double least = SHORTEST * (q->times.hi - q->times.lo);
    while (code == IMP_SUCCESS && !(s.lower[k] > enough) && s.count < SPANS &&
           q->looks < LOOKS_MOST && s.from[k + 1] - s.from[k] > least &&
           s.from[k] < 0.5 * s.from[k] + 0.5 * s.from[k + 1] &&
           0.5 * s.from[k] + 0.5 * s.from[k + 1] < s.from[k + 1]) {
        code = halve(q, &s, k);
        k = lowest(&s);
    }
    *lower = s.lower[k];
    return code;
}

/* How often radii are measured of one spine, and which part of what exceeds the limit they may
 * take. */
enum { MEASURES = 16 };
#define SHARE 0.75

/* Measures a spine so that *least, which falls with its radius, stays above the limit. */
static imp_code measure(spine_query *q, int side, double limit, double *least, bool *known)
{
    spine *line = &q->line[side];
    *known = false;
    for (int k = 0; k < MEASURES && !*known && *least > limit; ++k) {
        const double before = line->radius, goal = before + SHARE * (*least - limit);
        const imp_code code = spine_measure(line, &q->times, goal, known, q->error);
        if (code != IMP_SUCCESS || (!*known && !(line->radius > before))) return code;
        *least -= line->radius - before;
    }
    return IMP_SUCCESS;
}

/* A bound is kept as a float: it has to exceed the limit by this part. Where radii are not known as
 * well as they have to be, the limit has to fall to that part before it is tried again. */
#define ABOVE 0x1p-20
#define BELOW 0.75

imp_code spine_part(const distance_sides *of, const time_window *times, double limit, double *lower,
                    double *hope, imp_error *error)
{
    spine_query q = {.of = of, .times = *times, .error = error};
    double least = 0;
    *lower = *hope = 0;
    for (int k = 0; k < 2; ++k) q.has[k] = spine_choose(of->root[k]->surface, &q.times, &q.line[k]);
    imp_code code = choose(&q, limit, &least, hope);
    if (code != IMP_SUCCESS || !(least > limit)) return code;
    *hope = BELOW * limit;
    for (int k = 0; k < 2; ++k) {
        bool known;
        if (k != q.side && q.goal != OTHER_SPINE) continue;
        code = measure(&q, k, limit, &least, &known);
        if (code != IMP_SUCCESS || !known) return code;
    }
    q.most = 2 * least;
    return bound_all(&q, limit * (1 + ABOVE), lower);
}
