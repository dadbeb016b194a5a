/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/walk_internal.h"

#include <stdlib.h>

static bool find_point(walk *w, int k, jet *room, ld_interval x[3])
{
    const statement *s = w->says;
    const point *q = &s->point[k];
    const chain *c = &s->chains[q->chain];
    values when = {.count = s->clock_count};
    for (size_t i = 0; i < s->clock_count; ++i) when.lo[i] = when.hi[i] = s->clocks[i].at;
    const place p = {s, c, q->piece, c->count - 1, room, NULL, &when};
    const box3 where = {{q->u, q->v, when.lo[0]}, {q->u, q->v, when.lo[0]}};
    jet out[3], same[3];
    split unused;
    if (enclose(&p, &where, where.lo, out, same, &unused) != ENCLOSED)
        return input_refuse(w->in, "a point is outside of its surface, or has no value");
    for (int i = 0; i < 3; ++i) x[i] = out[i].v;
    return true;
}

static bool check_points(walk *w)
{
    const statement *s = w->says;
    const point *p = s->point;
    for (int k = 0; k < 2; ++k) {
        if (p[k].chain >= s->chain_count) return input_refuse(w->in, "a point is on no surface");
        if (p[k].piece >= s->stages[s->chains[p[k].chain].stages[0]].count)
            return input_refuse(w->in, "a point is on no piece");
    }
    if (statement_ignores(s, s->chains[p[0].chain].body, s->chains[p[1].chain].body))
        return input_refuse(w->in, "the points are of bodies that are not tested");
    for (size_t k = 0; k < s->clock_count; ++k) {
        const scene_clock *t = &s->clocks[k];
        if (!(t->lo <= t->at && t->at <= t->hi))
            return input_refuse(w->in, "the points are of another time");
    }
    return true;
}

bool walk_points(walk *w)
{
    const statement *s = w->says;
    ld_interval x[2][3], sum = ld_interval_of(0);
    bool said = true;
    if (!s->has_points) return true;
    if (!check_points(w)) return false;
    for (int k = 0; k < 2; ++k) {
        const chain *c = &s->chains[s->point[k].chain];
        if (!statement_is_said(s, c)) walk_note_assumed(w, c), said = false;
    }
    if (!said) return true;
    jet *room = malloc((2 * (size_t)s->steps + 1) * sizeof *room);
    bool good = room != NULL || input_refuse(w->in, "memory ran out");
    for (int k = 0; k < 2 && good; ++k) good = find_point(w, k, room, x[k]);
    free(room);
    if (!good) return false;
    for (int i = 0; i < 3; ++i)
        sum = ld_interval_add(sum, ld_interval_sqr(ld_interval_sub(x[1][i], x[0][i])));
    const ld_interval gap = ld_interval_sqrt(sum);
    if (gap.hi <= s->within) return true;
    return input_refuse(w->in, "the points stated are %.9g apart, claimed within %.9g", gap.hi,
                        s->within);
}
