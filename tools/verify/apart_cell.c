/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "tools/verify/apart_internal.h"

place cell_piece(const prover *p, int side, size_t k)
{
    place of = p->side[side];
    of.piece = p->order[side] != NULL ? p->order[side][k] : k;
    return of;
}

static void take_domain(const prover *p, cell *c, int side)
{
    const place of = cell_piece(p, side, c->first[side]);
    box3 b;
    piece_box(&of, &b);
    for (int j = 0; j < 2; ++j) c->lo[side][j] = b.lo[j], c->hi[side][j] = b.hi[j];
}

void cell_begin(const prover *p, cell *c)
{
    for (int side = 0; side < 2; ++side)
        if (c->count[side] == 1) take_domain(p, c, side);
}

/* Sets the ends of both halves; false: the place is not inside. */
static bool halve(double lo, double hi, double at, double *first, double *second)
{
    *first = *second = isnan(at) ? middle(lo, hi) : at;
    return lo < *first && *first < hi;
}

bool cell_split(const prover *p, const cell *c, const cut *by, cell half[2])
{
    const int side = by->side, along = by->along;
    half[0] = half[1] = *c;
    if (side == 3) {
        double unused;
        return halve(p->when.lo[along], p->when.hi[along], by->at, &unused, &unused);
    }
    if (side == 2) return halve(c->t[0], c->t[1], by->at, &half[0].t[1], &half[1].t[0]);
    if (c->count[side] > 1) {
        half[0].count[side] = c->count[side] / 2;
        half[1].first[side] += half[0].count[side];
        half[1].count[side] -= half[0].count[side];
        for (int k = 0; k < 2; ++k)
            if (half[k].count[side] == 1) take_domain(p, &half[k], side);
        return true;
    }
    return halve(c->lo[side][along], c->hi[side][along], by->at, &half[0].hi[side][along],
                 &half[1].lo[side][along]);
}

values_kept values_halve(prover *p, const cut *by, int half)
{
    double *lo = &p->when.lo[by->along], *hi = &p->when.hi[by->along];
    const values_kept was = {p->when.stamp, *lo, *hi};
    if (by->side != 3) return was;
    *(half == 0 ? hi : lo) = isnan(by->at) ? middle(*lo, *hi) : by->at;
    p->when.stamp = ++*p->stamps;
    return was;
}

void values_restore(prover *p, const cut *by, const values_kept *was)
{
    p->when.stamp = was->stamp;
    if (by->side == 3) p->when.lo[by->along] = was->lo, p->when.hi[by->along] = was->hi;
}

static box3 box_of(const cell *c, int side)
{
    return (box3){{c->lo[side][U], c->lo[side][V], c->t[0]},
                  {c->hi[side][U], c->hi[side][V], c->t[1]}};
}

box3 cell_area(const prover *p, const cell *c, int side, size_t k, place *of)
{
    box3 where = box_of(c, side);
    *of = cell_piece(p, side, c->first[side] + k);
    if (c->count[side] > 1) piece_box(of, &where);
    return where;
}
