/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/walk_internal.h"

#include <math.h>
#include <stdlib.h>

/* Reads an order of all pieces. */
static bool read_order(pair *p, int side, size_t count)
{
    input *in = p->w->in;
    p->order[side] = NULL;
    if (count < 2 || input_count(in, 1) == 0) return !input_is_refused(in);
    uint32_t *order = malloc(count * sizeof *order);
    bool *seen = calloc(count, sizeof *seen);
    if (order == NULL || seen == NULL) input_refuse(in, "memory ran out");
    for (size_t k = 0; k < count && !input_is_refused(in); ++k) {
        order[k] = (uint32_t)input_count(in, count - 1);
        if (seen[order[k]]) input_refuse(in, "an order names piece %u twice", order[k]);
        seen[order[k]] = true;
    }
    free(seen);
    p->order[side] = order;
    return !input_is_refused(in);
}

/* Lemma. Maps that both chains end with, each of which shrinks no length by more than the root of 1
 * - d, leave two points at one time farther apart than c wherever they are farther apart than c /
 * sqrt(1 - d) ... before them. */
static bool leave_out(pair *p, size_t count)
{
    const statement *s = p->w->says;
    input *in = p->w->in;
    const chain *a = p->chain[0], *b = p->chain[1];
    ld_interval shrunk = ld_interval_of(1);
    if (count >= a->count || count >= b->count)
        return input_refuse(in, "more maps are left out than there are");
    for (size_t k = 1; k <= count; ++k) {
        const size_t map = a->stages[a->count - k];
        if (map != b->stages[b->count - k])
            return input_refuse(in, "maps are left out that the surfaces do not share");
        if (!p->is_said) continue;
        const scene_clock *t = &s->clocks[s->stages[map].clock];
        double *of_map = &p->deviations[map];
        if (isnan(*of_map))
            *of_map = map_deviation_upper(s, map, t->lo, t->hi, p->prover.side[0].room);
        const double d = *of_map;
        if (!(d < 0.5))
            return input_refuse(in, "map %zu (%s), left out, is not proved to be rigid", map,
                                s->stages[map].type);
        const ld_interval square = ld_interval_sub(ld_interval_of(1), ld_interval_of(d));
        shrunk = ld_interval_mul(shrunk, ld_interval_sqrt(square));
    }
    const ld_interval apart = ld_interval_div(ld_interval_of(s->apart), shrunk);
    p->prover.apart = nextafter((double)apart.hi, INFINITY);
    if (s->apart == 0) p->prover.apart = 0;
    for (int side = 0; side < 2; ++side)
        p->prover.side[side].maps = p->chain[side]->count - 1 - count;
    return true;
}

void walk_note_assumed(walk *w, const chain *c)
{
    for (size_t k = 0; k < c->count; ++k) {
        const stage *g = &w->says->stages[c->stages[k]];
        for (size_t i = 0; i < g->count; ++i)
            if (g->pieces[i].count == 0) w->assumed[c->stages[k]] = true;
    }
}

/* Memory of all pairs. */
typedef struct work {
    jet *steps;
    memory *known;
    memo *memos;
    double *deviations;
} work;

/* Reads which clock is T, and begins with all values of all of them. */
static bool begin_values(pair *p, cell *c)
{
    const statement *s = p->w->says;
    values *when = &p->prover.when;
    when->count = s->clock_count;
    for (size_t k = 0; k < s->clock_count; ++k)
        when->lo[k] = s->clocks[k].lo, when->hi[k] = s->clocks[k].hi;
    when->stamp = s->clock_count > 1 ? ++p->w->stamps : 0;
    when->main = s->clock_count > 1 ? input_count(p->w->in, s->clock_count - 1) : 0;
    c->t[0] = when->lo[when->main], c->t[1] = when->hi[when->main];
    return !input_is_refused(p->w->in);
}

static bool take_pair(walk *w, size_t a, size_t b, const work *room)
{
    const statement *s = w->says;
    pair p = {.w = w, .chain = {&s->chains[a], &s->chains[b]}, .deviations = room->deviations};
    cell c = {.t = {0, 0}};
    p.is_said = statement_is_said(s, p.chain[0]) && statement_is_said(s, p.chain[1]);
    p.prover.tests_most = w->effort;
    p.prover.known = room->known;
    p.prover.stamps = &w->stamps;
    w->pairs += 1;
    if (input_count(w->in, UINT32_MAX) != a || input_count(w->in, UINT32_MAX) != b)
        return input_refuse(w->in, "the tree of surfaces %zu and %zu is not here", a, b);
    for (int side = 0; side < 2; ++side) {
        p.prover.side[side] =
            (place){s, p.chain[side], 0, 0, room->steps, room->memos, &p.prover.when};
        c.count[side] = s->stages[p.chain[side]->stages[0]].count;
        if (!p.is_said) walk_note_assumed(w, p.chain[side]);
        if (c.count[side] == 0) return input_refuse(w->in, "a surface has no pieces");
    }
    if (w->text != NULL)
        fprintf(w->text, "pair %zu %zu: '%s' and '%s'\n", a, b, s->bodies[p.chain[0]->body],
                s->bodies[p.chain[1]->body]);
    double at;
    if (p.is_said && enclose_ends_meet(s, p.chain[0], p.chain[1], &at))
        return input_refuse(
            w->in, "one surface ends and another begins at %.17g, which is not proved", at);
    bool good = leave_out(&p, input_count(w->in, UINT32_MAX)) && begin_values(&p, &c);
    jumps both = {.at = {NULL}};
    if (good && p.is_said && !jumps_find(p.prover.side, &both))
        good = input_refuse(w->in, "memory ran out");
    p.prover.jumps = &both;
    for (int side = 0; side < 2 && good; ++side) {
        good = read_order(&p, side, c.count[side]);
        p.prover.order[side] = p.order[side];
    }
    if (good && p.is_said) cell_begin(&p.prover, &c);
    good = good && walk_take_tree(&p, &c);
    for (int side = 0; side < 2; ++side) {
        free(p.order[side]);
        free(p.prover.areas[side].at);
    }
    jumps_free(&both);
    return good;
}

/* Proves all pairs of surfaces of two bodies, in the order of the scene. */
static bool take_bodies(walk *w, size_t a, size_t b, const size_t *first, const work *room)
{
    for (size_t i = first[a]; i < first[a + 1]; ++i)
        for (size_t j = first[b]; j < first[b + 1]; ++j)
            if (!take_pair(w, i, j, room)) return false;
    return true;
}

static bool find_first(walk *w, size_t *first)
{
    const statement *s = w->says;
    size_t k = 0;
    for (size_t b = 0; b <= s->body_count; ++b) {
        first[b] = k;
        while (b < s->body_count && k < s->chain_count && s->chains[k].body == b) ++k;
    }
    return k == s->chain_count || input_refuse(w->in, "surfaces are not in the order of bodies");
}

bool walk_trees(walk *w)
{
    const statement *s = w->says;
    size_t *first = malloc((s->body_count + 1) * sizeof *first);
    const work room = {malloc((2 * (size_t)s->steps + 1) * sizeof *room.steps),
                       calloc(1, sizeof *room.known),
                       calloc(s->stage_count + 1, sizeof *room.memos),
                       malloc((s->stage_count + 1) * sizeof *room.deviations)};
    bool good = first != NULL && room.steps != NULL && room.known != NULL && room.memos != NULL &&
                room.deviations != NULL;
    if (!good) input_refuse(w->in, "memory ran out");
    for (size_t k = 0; good && k < s->stage_count; ++k) room.deviations[k] = NAN;
    good = good && find_first(w, first);
    for (size_t a = 0; a < s->body_count && good; ++a)
        for (size_t b = a + 1; b < s->body_count && good; ++b)
            if (!statement_ignores(s, a, b)) good = take_bodies(w, a, b, first, &room);
    free(first);
    free(room.steps);
    look_free(room.known);
    for (size_t k = 0; k < s->stage_count && room.memos != NULL; ++k) free(room.memos[k].value);
    free(room.memos);
    free(room.deviations);
    return good && input_end(w->in);
}
