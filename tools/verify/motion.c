/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdlib.h>

#include "tools/verify/motion_internal.h"
#include "tools/verify/net_internal.h"

/* What an affine map is at all values of its clock: middle + s slope, |s| <= 1, but for `rest`. */
typedef struct line_map {
    affine middle, slope; /* constants */
    double rest[3][4];
} line_map;

static void take_line(const part *p, double lo, double hi, const affine *all, jet room[],
                      line_map *to)
{
    affine a;
    affine_take(p, lo, hi, room, &a);
    to->middle = to->slope = *all; /* for the offset */
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            double line[2];
            motion_line_of_jets(&a.wide[i][c], &a.centre[i][c], lo, hi, line, &to->rest[i][c]);
            to->middle.wide[i][c] = to->middle.centre[i][c] =
                jet_constant(1, ld_interval_of(line[0]));
            to->slope.wide[i][c] = to->slope.centre[i][c] =
                jet_constant(1, ld_interval_of(line[1]));
        }
}

static double size_of(const affine *x, int i, int c) { return ld_interval_mag(x->wide[i][c].v); }

/* Lemma. For `then` = M + s L but for e, |s| <= 1, and x = base + ways but for rest, then(x) is
 * M base + (M ways + s L base) but for |M| rest + |L| (|ways| + rest) + e (|base| + |ways| + rest),
 * and for e alone of the shift. */
static void grow_rest(const affine *m, const line_map *line, layered *x)
{
    double was[3][4], moved[3][4];
    for (int l = 0; l < 3; ++l)
        for (int c = 0; c < 4; ++c) {
            was[l][c] = moved[l][c] = x->rest[l][c];
            for (size_t k = 0; k < x->count; ++k) moved[l][c] += size_of(&x->ways[k].of, l, c);
        }
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            double sum = line != NULL && c == 3 ? line->rest[i][3] : 0;
            for (int l = 0; l < 3; ++l) {
                sum += size_of(m, i, l) * was[l][c];
                if (line == NULL) continue;
                sum += size_of(&line->slope, i, l) * moved[l][c];
                sum += line->rest[i][l] * (size_of(&x->base, l, c) + moved[l][c]);
            }
            x->rest[i][c] = sum > 0 || isnan(sum) ? net_padded(sum) : 0;
            if (isnan(sum)) x->rest[i][c] = INFINITY;
        }
}

static void add_slope(const affine *slope, const affine *base, affine *way)
{
    affine more = *base;
    affine_compose(slope, &more, true);
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            way->wide[i][c] = jet_add(&way->wide[i][c], &more.wide[i][c]);
            way->centre[i][c] = jet_add(&way->centre[i][c], &more.centre[i][c]);
        }
}

void affine_set(affine *x, bool is_one)
{
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c)
            x->wide[i][c] = x->centre[i][c] = jet_constant(1, ld_interval_of(is_one && i == c));
}

/* Applies a map that follows T, or (line not NULL) another clock. */
static void apply(const affine *m, const line_map *line, size_t clock, layered *x)
{
    if (line != NULL || x->count > 0) grow_rest(m, line, x);
    for (size_t k = 0; k < x->count; ++k) affine_compose(m, &x->ways[k].of, false);
    if (line != NULL) {
        size_t k = 0;
        while (k < x->count && x->ways[k].clock != clock) ++k;
        if (k == x->count) {
            x->ways[x->count++].clock = clock;
            x->ways[k].of = x->base;
            affine_set(&x->ways[k].of, false);
        }
        add_slope(&line->slope, &x->base, &x->ways[k].of);
    }
    affine_compose(m, &x->base, true);
}

static void apply_stage(const place *p, size_t k, const part *found, double lo, double hi,
                        layered *x)
{
    const size_t clock = p->of->stages[p->chain->stages[k]].clock;
    affine next;
    line_map line;
    if (place_follows_main(p, k)) {
        affine_take(found, lo, hi, p->room, k == 1 ? &x->base : &next);
        if (k > 1) apply(&next, NULL, 0, x);
        return;
    }
    if (k == 1) {
        const double at = middle(lo, hi);
        x->base.offset[0] = ld_interval_sub(ld_interval_make(lo, hi), ld_interval_of(at));
        affine_set(&x->base, true);
    }
    take_line(found, p->when->lo[clock], p->when->hi[clock], &x->base, p->room, &line);
    apply(&line.middle, &line, clock, x);
}

enclosed motion_take_chain(const place *p, double lo, double hi, layered *all, bool *all_affine,
                           split *divide)
{
    const box3 times = {{-INFINITY, -INFINITY, lo}, {INFINITY, INFINITY, hi}};
    size_t others = 0;
    for (size_t k = 1; k <= p->maps; ++k) others += !place_follows_main(p, k);
    *all = (layered){.ways = others > 0 ? malloc(others * sizeof *all->ways) : NULL};
    *all_affine = p->maps > 0 && (others == 0 || all->ways != NULL);
    for (size_t k = 1; k <= p->maps; ++k) {
        const part *found;
        const piece *map = enclose_piece(p, k);
        const box3 own = place_box(p, k, &times);
        const enclosed result = enclose_choose(p, k, &times, &found, divide);
        if (result != ENCLOSED) return result == ENCLOSED_EMPTY ? ENCLOSED_UNSAID : result;
        *all_affine =
            *all_affine && found->is_affine && enclose_next_part(map, found, &own) == NULL;
        if (*all_affine) apply_stage(p, k, found, lo, hi, all);
    }
    return ENCLOSED;
}

/* Writes the numbers of base and ways; false: they are not finite, or there is no memory. */
static bool take_numbers(const layered *all, double lo, double hi, motion *m)
{
    double error, size;
    bool known = true;
    if (all->count > 0) m->ways = malloc(all->count * sizeof *m->ways);
    if (all->count > 0 && m->ways == NULL) return false;
    m->way_count = all->count;
    for (size_t k = 0; k < all->count; ++k) m->ways[k].clock = all->ways[k].clock;
    for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 4; ++c) {
            known = known && motion_of_jets(&all->base.wide[i][c], &all->base.centre[i][c], lo, hi,
                                            m->m[i][c], &m->error[i][c], &m->size[i][c]);
            if (all->count == 0) continue;
            for (size_t k = 0; k < all->count && known; ++k) {
                const affine *way = &all->ways[k].of;
                known = motion_of_jets(&way->wide[i][c], &way->centre[i][c], lo, hi,
                                       m->ways[k].m[i][c], &error, &size);
                m->error[i][c] += error;
                m->size[i][c] += size;
            }
            m->blur[i][c] = all->rest[i][c];
            m->error[i][c] = net_padded(m->error[i][c] + all->rest[i][c]);
            m->size[i][c] = net_padded(m->size[i][c] + all->rest[i][c]);
            known = known && m->size[i][c] < INFINITY;
        }
    return known;
}

enclosed motion_bound(const place *p, double lo, double hi, motion *m, bool *all_affine,
                      split *divide)
{
    layered all;
    const enclosed result = motion_take_chain(p, lo, hi, &all, all_affine, divide);
    if (*all_affine && result == ENCLOSED) *all_affine = take_numbers(&all, lo, hi, m);
    free(all.ways);
    return result;
}
