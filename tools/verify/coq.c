/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/coq.h"

#include <math.h>
#include <stdlib.h>

#include "core/common/random.h"
#include "tools/verify/apart_internal.h"
#include "tools/verify/coq_goal.h"
#include "tools/verify/coq_text.h"

struct coq {
    watch watch;
    goal *goals;
    size_t count, most;
    uint64_t seed, leaves, known; /* leaves seen, and those that could be drawn */
};

/* --- Drawing ---------------------------------------------------------------------------------- */

static size_t draw(coq *q, size_t below)
{
    return (size_t)(random_fraction(&q->seed) * (double)below);
}

static bool is_told(const place *of, const box3 *where)
{
    const part **parts = malloc((of->maps + 1) * sizeof *parts);
    const bool told = parts != NULL && coq_find_parts(of, where, parts);
    free(parts);
    return told;
}

/* Takes the line in time midway between both sides, and how far either reaches from it, at most, by
 * its coefficients, of which those of a line are its values at equal distances. */
static void take_line(const double *const upper[2], const double t[2], goal *g, double far[2])
{
    const int last = NET_TIMES - 1;
    const double rise = 0.5 * (upper[0][last] - upper[0][0] - (upper[1][last] - upper[1][0]));
    g->slope = t[1] > t[0] ? rise / (t[1] - t[0]) : 0;
    g->mid = 0.5 * t[0] + 0.5 * t[1];
    far[0] = far[1] = -INFINITY;
    for (int k = 0; k <= last; ++k) {
        const double line = g->slope * (t[0] + (t[1] - t[0]) * k / last - g->mid);
        far[0] = proof_larger(far[0], upper[0][k] - line);
        far[1] = proof_larger(far[1], upper[1][k] + line);
    }
}

/* Takes boxes of either side that the prover has enclosed. What is left over between them is
 * divided among both, so that Coq's bounds may be a little wider. False: no axis parted the cell,
 * or the formulas cannot be told. */
static bool take_goal(coq *q, const prover *p, goal *g)
{
    const aim *a = &p->aim;
    double far[2];
    const double *upper[2];
    ld_interval square = ld_interval_of(0);
    if (a->about != NULL || p->is_round || p->areas[0].count == 0 || p->areas[1].count == 0)
        return false;
    *g = (goal){.leaf = q->leaves, .when = p->when, .apart = p->apart};
    for (int side = 0; side < 2; ++side) {
        const area *drawn = &p->areas[side].at[draw(q, p->areas[side].count)];
        g->of[side] = drawn->of;
        g->where[side] = drawn->where;
        upper[side] = drawn->upper;
        if (!is_told(&drawn->of, &drawn->where)) return false;
    }
    for (int i = 0; i < 3; ++i) {
        g->n[i] = a->n[i];
        square = ld_interval_add(square, ld_interval_sqr(ld_interval_of(a->n[i])));
    }
    take_line(upper, p->tried.t, g, far);
    const double left = -(far[0] + far[1]) - ld_interval_sqrt(square).hi * p->apart;
    g->upper = far[0] + 0.49 * left;
    g->lower = -(far[1] + 0.49 * left);
    for (int k = 0; k < 2; ++k) {
        g->t[k] = k == 0 ? fmax(g->where[0].lo[T], g->where[1].lo[T])
                         : fmin(g->where[0].hi[T], g->where[1].hi[T]);
    }
    return left >= 0 && g->t[0] <= g->t[1];
}

/* Keeps each leaf of those that can be told with the same probability. */
static void leaf_read(void *context, prover *p, const cell *c, bool named)
{
    coq *q = context;
    goal g;
    (void)c, (void)named;
    const bool told = take_goal(q, p, &g);
    q->leaves += 1;
    if (!told) return;
    q->known += 1;
    const size_t at = q->count < q->most ? q->count++ : draw(q, (size_t)q->known);
    if (at < q->most) q->goals[at] = g;
}

static void nothing(void *context) { (void)context; }

static void split_read(void *context, const uint8_t *bytes, size_t size)
{
    (void)context, (void)bytes, (void)size;
}

static void joined(void *context, prover *p, const cell *c) { (void)context, (void)p, (void)c; }

coq *coq_begin(walk *w, size_t count, uint64_t seed)
{
    coq *q = calloc(1, sizeof *q);
    if (q == NULL) return NULL;
    q->goals = calloc(count, sizeof *q->goals);
    q->most = count;
    q->seed = seed;
    q->watch = (watch){q, nothing, split_read, leaf_read, joined, nothing};
    w->watch = &q->watch;
    if (q->goals != NULL) return q;
    coq_free(q);
    return NULL;
}

void coq_free(coq *q)
{
    if (q != NULL) free(q->goals);
    free(q);
}

size_t coq_write(const coq *q, FILE *to, uint64_t *known)
{
    coq_put_head(to);
    for (size_t k = 0; k < q->count; ++k) coq_put_goal(to, &q->goals[k]);
    *known = q->known;
    return q->count;
}
