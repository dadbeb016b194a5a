/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/walk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEPTH_MAX = 4000, LEAVES_A_SHARE = 16 };

typedef struct pair {
    walk *w;
    const chain *chain[2];
    prover prover;
    double *deviations; /* of maps that are left out from being rigid; NAN: not known */
    uint32_t *order[2];
    bool is_said;
    bool has_axis; /* of a leaf before in this tree */
    double axis[3];
} pair;

/* --- Leaves ----------------------------------------------------------------------------------- */

static void say_side(const pair *p, const cell *c, int side, char *text, size_t size)
{
    const statement *s = p->w->says;
    const char *name = s->bodies[p->chain[side]->body];
    if (c->count[side] > 1)
        snprintf(text, size, "'%.60s', %zu pieces", name, c->count[side]);
    else
        snprintf(text, size, "'%.60s' piece %zu, u [%.9g, %.9g], v [%.9g, %.9g]", name,
                 (size_t)(p->order[side] != NULL ? p->order[side][c->first[side]] : c->first[side]),
                 c->lo[side][0], c->hi[side][0], c->lo[side][1], c->hi[side][1]);
}

static const char *clock_name(const statement *s, size_t clock)
{
    return clock == 0 ? "t" : s->clocks[clock].name;
}

/* The values of clocks beside T, of which there is room for some. */
static void say_values(const pair *p, char *text, size_t size)
{
    const values *when = &p->prover.worst_when;
    size_t used = 0;
    text[0] = '\0';
    for (size_t k = 1; k < when->count && used + 200 < size; ++k)
        if (k != when->main)
            used += (size_t)snprintf(text + used, size - used, ", %.60s [%.17g, %.17g]",
                                     clock_name(p->w->says, k), when->lo[k], when->hi[k]);
}

static bool refuse(pair *p)
{
    const prover *q = &p->prover;
    char a[300], b[300], found[120] = "", others[500];
    say_side(p, &q->worst, 0, a, sizeof a);
    say_side(p, &q->worst, 1, b, sizeof b);
    say_values(p, others, sizeof others);
    if (q->found < INFINITY) snprintf(found, sizeof found, ": %.9g apart", q->found);
    if (q->ran_out)
        snprintf(found, sizeof found, "; not finished, not found false: try --effort above %lu",
                 q->tests_most);
    return input_refuse(p->w->in, "%s and %s, %.60s [%.17g, %.17g]%s, claimed apart by %.9g: %s%s",
                        a, b, clock_name(p->w->says, q->when.main), q->worst.t[0], q->worst.t[1],
                        others, p->w->says->apart, q->why, found);
}

/* Passes over how the kernel divides a side: 2 ends a branch, others begin two. */
static void skip_side(input *in)
{
    for (uint64_t open = 1; open > 0 && !input_is_refused(in);)
        open = input_count(in, 2) < 2 ? open + 1 : open - 1;
}

/* Not inlined: a tree of DEPTH_MAX would take more than the 8 MB of a stack with its buffers. */
__attribute__((noinline)) static bool take_leaf(pair *p, const cell *c, unsigned op)
{
    walk *w = p->w;
    prover *q = &p->prover;
    if (op == WALK_AXIS || op == WALK_SIDES) {
        for (int i = 0; i < 3; ++i) p->axis[i] = (int16_t)input_16(w->in);
        p->has_axis = true;
    }
    for (int side = 0; side < 2 && op == WALK_SIDES; ++side) skip_side(w->in);
    if (op == WALK_SAME && !p->has_axis) return input_refuse(w->in, "a leaf before had no axis");
    if (w->text != NULL && op == WALK_ALONE) fprintf(w->text, "leaf\n");
    if (w->text != NULL && op != WALK_ALONE)
        fprintf(w->text, "leaf axis %g %g %g\n", p->axis[0], p->axis[1], p->axis[2]);
    for (int i = 0; i < 3; ++i) q->axis[i] = op == WALK_ALONE ? 0 : p->axis[i];
    if (w->leaves % LEAVES_A_SHARE == 0) prover_forget(q);
    const bool mine = w->leaves++ / LEAVES_A_SHARE % w->shares == w->share;
    if (w->progress != NULL) w->progress(w->in->at);
    if (!mine || !p->is_said || input_is_refused(w->in)) return !input_is_refused(w->in);
    const bool proved = prove_apart(q, c);
    w->tests += q->tests;
    if (!proved) return refuse(p);
    if (w->watch != NULL) w->watch->leaf(w->watch->context, q, c, op != WALK_ALONE);
    return true;
}

/* --- Trees ------------------------------------------------------------------------------------ */

static void say_split(const pair *p, const cell *c, const cut *by)
{
    if (p->w->text == NULL) return;
    if (by->side >= 2)
        fprintf(p->w->text, "split %s %a\n",
                clock_name(p->w->says, by->side == 2 ? p->prover.when.main : (size_t)by->along),
                by->at);
    else if (c->count[by->side] > 1)
        fprintf(p->w->text, "split %c pieces\n", "AB"[by->side]);
    else
        fprintf(p->w->text, "split %c %c\n", "AB"[by->side], "uv"[by->along]);
}

/* A split, and its bytes. */
typedef struct entry {
    cut by;
    uint8_t bytes[4];
    size_t size;
} entry;

/* Reads the rest of a split. Halves cover the cell even if one is not smaller, if the place is in
 * the cell. */
static bool read_split(pair *p, const cell *c, unsigned op, entry *e)
{
    input *in = p->w->in;
    const values *when = &p->prover.when;
    *e = (entry){{(int)op / 2, (int)op % 2, NAN}, {(uint8_t)op}, 1};
    double lo = c->t[0], hi = c->t[1];
    if (op == WALK_CLOCK) {
        const size_t clock = input_count(in, when->count - 1);
        if (clock == when->main) return input_refuse(in, "a clock is divided that is T");
        lo = when->lo[clock], hi = when->hi[clock];
        e->by = (cut){3, (int)clock, NAN};
        e->bytes[e->size++] = (uint8_t)clock;
    }
    if (op >= WALK_TIME) {
        const unsigned k16 = input_16(in);
        e->by.at = lo + (hi - lo) * (k16 / 65536.0);
        e->bytes[e->size++] = (uint8_t)(k16 >> 8);
        e->bytes[e->size++] = (uint8_t)k16;
        if (!(lo <= e->by.at && e->by.at <= hi))
            return input_refuse(in, "time is divided outside of the cell");
    } else if (c->count[e->by.side] > 1 && e->by.along != 0) {
        return input_refuse(in, "pieces are divided along v");
    }
    return !input_is_refused(in);
}

static bool take_entry(pair *p, const cell *c, int depth)
{
    input *in = p->w->in;
    cell half[2];
    entry e;
    const unsigned op = input_byte(in);
    const bool is_unknown = op > WALK_SIDES || (op == WALK_CLOCK && p->w->says->clock_count < 2);
    if (is_unknown || depth > DEPTH_MAX)
        return input_refuse(in, is_unknown ? "an entry is unknown" : "the tree is too deep");
    if (input_is_refused(in)) return false;
    if (op > WALK_TIME && op != WALK_CLOCK) return take_leaf(p, c, op);
    if (!read_split(p, c, op, &e)) return false;
    say_split(p, c, &e.by);
    cell_split(&p->prover, c, &e.by, half);
    const watch *told = p->is_said ? p->w->watch : NULL;
    if (told != NULL) told->split(told->context, e.bytes, e.size);
    bool good = true;
    for (int k = 0; k < 2 && good; ++k) {
        const values_kept was = values_halve(&p->prover, &e.by, k);
        good = take_entry(p, &half[k], depth + 1);
        values_restore(&p->prover, &e.by, &was);
    }
    if (good && told != NULL) told->joined(told->context, &p->prover, c);
    return good;
}

static bool take_tree(pair *p, const cell *c)
{
    const watch *told = p->is_said ? p->w->watch : NULL;
    if (told != NULL) told->begun(told->context);
    const bool good = take_entry(p, c, 0);
    if (good && told != NULL) told->ended(told->context);
    return good;
}

/* --- Pairs ------------------------------------------------------------------------------------ */

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

static void note_assumed(walk *w, const chain *c)
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
        if (!p.is_said) note_assumed(w, p.chain[side]);
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
    good = good && take_tree(&p, &c);
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

/* --- Points ----------------------------------------------------------------------------------- */

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
        if (!statement_is_said(s, c)) note_assumed(w, c), said = false;
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
