/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/claim_audit.h"

#include <string.h>

#include "core/base/rounding.h"
#include "core/common/random.h"
#include "core/tree/distance_audit.h"

/* A point of a surface, within `error` of the exact one. */
typedef struct place {
    double p[3], x[3]; /* u, v, t; length */
    double error;      /* of all coordinates together, at most; length */
} place;

static bool take(place *at, const double p[3], const double x[3], const double error[3])
{
    memcpy(at->p, p, sizeof at->p);
    memcpy(at->x, x, sizeof at->x);
    at->error = error[0] + error[1] + error[2];
    return isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]) && at->error >= 0 &&
           at->error < INFINITY;
}

static bool evaluate(const surface *s, const double p[3], place *at)
{
    double x[3], error[3];
    return surface_eval(s, 1, p, x, error) == IMP_STATUS_OK && take(at, p, x, error);
}

/* --- The nearest point of the other surface --------------------------------------------------- */

enum { SIDE = 8, GRID = SIDE * SIDE };
#define STEP_LEAST                                                                                 \
    0x1p-16 /* of the domain's widths: its square changes the distance's ninth digit */

/* An upper bound of the distance of two exact points. Rounding: differences, squares, sums, root: 5
 * of it, and 1 of the errors. */
PAD_COVERS(8, 5);
static double apart_upper(const place *a, const place *b)
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += (a->x[i] - b->x[i]) * (a->x[i] - b->x[i]);
    return padded_upper(sqrt(sum) + a->error + b->error, 8) + 0x1p-500;
}

typedef struct hunt {
    const surface *s;
    const place *from;
    double lo[2], width[2];
    place best;
    double apart;
} hunt;

static void try_points(hunt *h, const double p[3 * GRID], size_t count)
{
    double x[3 * GRID], error[3 * GRID];
    if (surface_eval(h->s, count, p, x, error) != IMP_STATUS_OK) return;
    for (size_t k = 0; k < 3 * count; k += 3) {
        place at;
        if (!take(&at, p + k, x + k, error + k)) continue;
        const double apart = apart_upper(h->from, &at);
        if (!(apart < h->apart)) continue;
        h->apart = apart;
        h->best = at;
    }
}

/* Seeks the nearest point: a grid over u and v, then steps along u and v, which are halved when
 * none comes nearer. */
static void seek_nearest(hunt *h)
{
    double p[3 * GRID];
    h->apart = INFINITY;
    for (int k = 0; k < GRID; ++k) {
        p[3 * k] = h->lo[0] + h->width[0] * (k / SIDE) / (SIDE - 1);
        p[3 * k + 1] = h->lo[1] + h->width[1] * (k % SIDE) / (SIDE - 1);
        p[3 * k + 2] = h->from->p[2];
    }
    try_points(h, p, GRID);
    for (double step = 0.5 / SIDE; step >= STEP_LEAST && h->apart < INFINITY;) {
        const double before = h->apart;
        for (int k = 0; k < 4; ++k) {
            const int j = k / 2;
            memcpy(p + 3 * k, h->best.p, sizeof h->best.p);
            const double moved = h->best.p[j] + (k % 2 ? -step : step) * h->width[j];
            const double hi = h->lo[j] + h->width[j];
            p[3 * k + j] = moved < h->lo[j] ? h->lo[j] : moved > hi ? hi : moved;
        }
        try_points(h, p, 4);
        if (!(h->apart < before)) step *= 0.5;
    }
}

/* --- The claim -------------------------------------------------------------------------------- */

/* Returns the lower bound of |g| at p; below 0: no claim. */
static double claimed_lower(const imp_model *g, const imp_region *r, const double p[3], bool slides)
{
    double s[3];
    for (int j = 0; j < 3; ++j) s[j] = r->d[j] > 0 ? (p[j] - r->c[j]) / r->d[j] : 0;
    if (slides) s[PARAMETER_T] = 0;
    return distance_claim_lower(g, s);
}

/* Whether the distance at that point and time alone is correct, so that the symmetry is wrong. */
static bool blames_symmetry(const distance_question *q, const place *at, double apart)
{
    const surface *b = q->b->surface;
    const imp_region r = region_make(at->p, at->p);
    imp_model point[3], g;
    for (int i = 0; i < 3; ++i) {
        point[i] = (imp_model){.a = at->x[i], .e = at->error};
        point[i].lo = difference_lower(at->x[i], at->error);
        point[i].hi = sum_upper(at->x[i], at->error);
    }
    if (!distance_slides(q)) return false;
    return surface_distance(b, &r, surface_map_count(b), point, &g) == IMP_STATUS_OK &&
           !(claimed_lower(&g, &r, at->p, false) > apart);
}

static imp_code refute(const distance_question *q, const place *at, const hunt *h, double claimed,
                       imp_error *error)
{
    const double *x = at->x, *p = h->best.p;
    const bool by_symmetry = blames_symmetry(q, at, h->apart);
    return surface_fault(
        q->b->surface, error,
        "%s: %s claims at least %.17g of the point (%.17g, %.17g, %.17g) at t = %.17g, "
        "which is %.17g from its point at u = %.17g, v = %.17g",
        by_symmetry ? "is not as symmetric as it says" : "claims too large a distance",
        by_symmetry ? "the distance from a surface that does not turn" : "distance", claimed, x[0],
        x[1], x[2], at->p[2], h->apart, p[0], p[1]);
}

/* --- Points of the node ----------------------------------------------------------------------- */

enum { POINTS = 6 };

/* Returns the seed for drawing points: the bits of the region's centre and the window, so that
 * every machine draws the same. */
static uint64_t seed_of(const imp_region *r, const time_window *when)
{
    const double from[4] = {r->c[0], r->c[1], when->lo, when->hi};
    uint64_t state = 0;
    for (int j = 0; j < 4; ++j) {
        uint64_t bits;
        memcpy(&bits, &from[j], sizeof bits);
        state = (state ^ bits) * 0x9e3779b97f4a7c15u;
    }
    return state;
}

static double draw_within(uint64_t *state, double lo, double hi)
{
    const double where = random_fraction(state);
    const double at = where < 0.25 ? lo : where > 0.75 ? hi : lo + (hi - lo) * 2 * (where - 0.25);
    return at < lo ? lo : at > hi ? hi : at;
}

imp_code claim_audit_run(const distance_question *q, const imp_model *g, const time_window *when,
                         imp_error *error)
{
    const imp_region *r = &q->a->region;
    double lo[3], hi[3];
    uint64_t state = seed_of(r, when);
    surface_domain(q->b->surface, lo, hi);
    for (int k = 0; k < POINTS; ++k) {
        const double p[3] = {draw_within(&state, r->lo[0], r->hi[0]),
                             draw_within(&state, r->lo[1], r->hi[1]),
                             draw_within(&state, when->lo, when->hi)};
        place at;
        double claimed = claimed_lower(g, r, p, distance_slides(q));
        if (q->is_ball) claimed = difference_lower(claimed, q->radius);
        if (!(claimed > 0) || !evaluate(q->a->surface, p, &at)) continue;
        hunt h = {.s = q->b->surface,
                  .from = &at,
                  .lo = {lo[0], lo[1]},
                  .width = {hi[0] - lo[0], hi[1] - lo[1]}};
        seek_nearest(&h);
        if (claimed > h.apart) return refute(q, &at, &h, claimed, error);
    }
    return IMP_SUCCESS;
}
