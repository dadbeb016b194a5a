/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/piece_walk.h"

#include "core/bounds/separation.h"
#include "core/bounds/tuning.h"

typedef struct walk {
    piece_walk *best;
    const candidate_pair *both;
    imp_stats *stats;
    int side;  /* whose pieces are tried */
    int tries; /* left */
} walk;

static imp_code try_pieces(walk *g, const pair *p, imp_error *error)
{
    const node *const nodes[2] = {p->a, p->b};
    witness seen;
    g->tries -= 1;
    g->stats->witness_searches += 1;
    const imp_code code = witness_seek(nodes, g->best->t, g->best->seen.gap_upper, &seen, error);
    if (code != IMP_SUCCESS || !(seen.gap_upper < g->best->seen.gap_upper)) return code;
    g->best->seen = seen;
    g->best->single = *p;
    return IMP_SUCCESS;
}

static double box_distance(const pair *p)
{
    return p->a->bounded && p->b->bounded ? separation_boxes_lower(p->a, p->b) : 0;
}

/* Tries the pieces below the side's node whose boxes are nearer than the witness, nearer halves
 * first. */
static imp_code try_below(walk *g, const pair *p, imp_error *error)
{
    const node *n = g->side == 0 ? p->a : p->b;
    if (!(p->window.lo <= g->best->t && g->best->t <= p->window.hi)) return IMP_SUCCESS;
    if (g->tries == 0 || !(box_distance(p) < g->best->seen.gap_upper)) return IMP_SUCCESS;
    if (n->many == NULL) return try_pieces(g, p, error);
    const cut c = {g->side, PARAMETER_U, 0};
    pair half[2] = {*p, *p};
    for (int k = 0; k < 2; ++k) {
        bool some;
        const imp_code code = cut_take(&c, k, g->both, &half[k], &some, g->stats, error);
        if (code != IMP_SUCCESS) return code;
    }
    const int first = box_distance(&half[1]) < box_distance(&half[0]) ? 1 : 0;
    const imp_code code = try_below(g, &half[first], error);
    return code == IMP_SUCCESS ? try_below(g, &half[!first], error) : code;
}

imp_code piece_walk_on(piece_walk *w, const pair *from, const candidate_pair *both,
                       imp_stats *stats, imp_error *error)
{
    walk g = {w, both, stats, 0, TUNING_WALK_TRIES};
    double before = INFINITY;
    for (int k = 0; k < 2 || w->seen.gap_upper < before; ++k) {
        pair p = w->single;
        if (k % 2 == 0) before = w->seen.gap_upper;
        g.side = (k + w->first) % 2;
        *(g.side == 0 ? &p.a : &p.b) = g.side == 0 ? from->a : from->b;
        const imp_code code = try_below(&g, &p, error);
        if (code != IMP_SUCCESS || g.tries == 0) return code;
    }
    return IMP_SUCCESS;
}
