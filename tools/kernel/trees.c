/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/kernel/kernel.h"

#include <stdlib.h>

static bool refuse(tree *r, const cell *c)
{
    char *const *bodies = r->w->of->bodies;
    const range *a = c->uv[0], *b = c->uv[1], t = c->clocks[0];
    return bytes_refuse(r->w->in, "'%.60s' u [%g, %g] and '%.60s' u [%g, %g], t [%g, %g]: %s",
                        bodies[r->p.side[0]->body], a->lo, a->hi, bodies[r->p.side[1]->body], b->lo,
                        b->hi, t.lo, t.hi, r->p.why);
}

/* The high byte comes first. */
static unsigned take_16(bytes *in)
{
    const unsigned high = bytes_next(in);
    return high << 8 | bytes_next(in);
}

void trees_split(const pair *p, const cell *c, int side, size_t along, double at, cell half[2])
{
    half[0] = half[1] = *c;
    if (side == 2) {
        half[0].clocks[along].hi = half[1].clocks[along].lo = at;
    } else if (c->count[side] == 1) {
        const double middle = range_middle(c->uv[side][along]);
        half[0].uv[side][along].hi = half[1].uv[side][along].lo = middle;
    } else {
        half[0].count[side] = c->count[side] / 2;
        half[1].first[side] += half[0].count[side];
        half[1].count[side] -= half[0].count[side];
        for (int k = 0; k < 2; ++k)
            if (half[k].count[side] == 1) leaf_box(p, side, half[k].first[side], half[k].uv[side]);
    }
}

/* Bounds a side of a leaf, which a tree of its own divides. */
static bool take_side(tree *r, const cell *c, int side, bool divided, bound *b, int depth)
{
    bytes *in = r->w->in;
    cell half[2];
    const unsigned along = divided ? (unsigned)bytes_count(in, TREES_WHOLE) : TREES_WHOLE;
    if (along == TREES_WHOLE) return r->p.of->apart == 0 || leaf_visit(&r->p, c, side, leaf_add, b);
    if (depth == TREES_DEPTH_MAX || (c->count[side] > 1 && along != 0))
        return bytes_refuse(in, "a side is divided along v, or too often");
    trees_split(&r->p, c, side, along, NAN, half);
    return bytes_are_good(in) && take_side(r, &half[0], side, true, b, depth + 1) &&
           take_side(r, &half[1], side, true, b, depth + 1);
}

static bool take_leaf(tree *r, const cell *c, unsigned op)
{
    trees *w = r->w;
    bound b[2] = {{.p = &r->p, .c = c}, {.p = &r->p, .c = c}};
    w->leaves += 1;
    r->p.why = "its axis does not part them; was it written by impinge-verify --elaborate?";
    for (int i = 0; i < 3; ++i) {
        if (op == TREES_AXIS || op == TREES_SIDES) r->axis[i] = (int16_t)take_16(w->in);
        b[0].n[i] = b[1].n[i] = op == TREES_ALONE ? 0 : r->axis[i];
    }
    if (!bytes_are_good(w->in)) return false;
    if (w->leaf != NULL) return w->leaf(w->context, r, c, op) || refuse(r, c);
    const bool divided = op == TREES_SIDES, seen = take_side(r, c, 0, divided, &b[0], 0) &&
                                                   take_side(r, c, 1, divided, &b[1], 0);
    return (seen && (w->of->apart == 0 || leaf_holds(&b[0], &b[1]))) || refuse(r, c);
}

static bool take_entry(tree *r, const cell *c, int depth)
{
    bytes *in = r->w->in;
    cell half[2];
    const unsigned op = bytes_next(in);
    int side = (int)op / 2;
    size_t along = op % 2;
    double at = 0;
    const bool known = op <= TREES_SIDES && (op != TREES_CLOCK || r->w->of->clock_count > 1);
    if (!known || depth > TREES_DEPTH_MAX)
        return bytes_refuse(in, "an entry is unknown, or the tree is too deep");
    if (op >= TREES_AXIS && op != TREES_CLOCK) return take_leaf(r, c, op);
    if (op >= TREES_TIME) {
        side = 2;
        along = op == TREES_TIME ? r->main : bytes_count(in, r->w->of->clock_count - 1);
        const range all = c->clocks[along];
        at = all.lo + (all.hi - all.lo) * (take_16(in) / 65536.0);
        if (!(all.lo <= at && at <= all.hi)) bytes_refuse(in, "a clock is divided outside");
    } else if (c->count[side] > 1 && along != 0) {
        bytes_refuse(in, "pieces are divided along v");
    }
    if (!bytes_are_good(in)) return false;
    trees_split(&r->p, c, side, along, at, half);
    return take_entry(r, &half[0], depth + 1) && take_entry(r, &half[1], depth + 1);
}

/* Reads an order of all pieces, if there are several. */
static uint32_t *read_order(bytes *in, size_t count)
{
    if (count < 2 || bytes_count(in, 1) == 0) return NULL;
    uint32_t *order = malloc(count * sizeof *order);
    uint8_t *seen = calloc(count, 1);
    if (order == NULL || seen == NULL) bytes_refuse(in, "memory ran out");
    for (size_t k = 0; k < count && bytes_are_good(in); ++k) {
        order[k] = (uint32_t)bytes_count(in, count - 1);
        if (seen[order[k]]++ > 0) bytes_refuse(in, "an order names piece %u twice", order[k]);
    }
    free(seen);
    return order;
}

static bool take_pair(trees *w, size_t a, size_t b)
{
    bytes *in = w->in;
    const surface *all = w->of->surfaces;
    tree r = {.w = w, .p = {.of = w->of, .side = {&all[a], &all[b]}}};
    cell c = {.first = {0, 0}};
    w->pairs += 1;
    if (bytes_count(in, UINT32_MAX) != a || bytes_count(in, UINT32_MAX) != b)
        return bytes_refuse(in, "the tree of two surfaces is not here");
    r.without = bytes_count(in, UINT32_MAX);
    if (r.without != 0 && w->leaf == NULL)
        return bytes_refuse(in, "maps are left out: impinge-verify --elaborate puts them back");
    if (w->of->clock_count > 1) r.main = bytes_count(in, w->of->clock_count - 1);
    for (size_t k = 0; k < w->of->clock_count; ++k) c.clocks[k] = w->of->clocks[k].all;
    for (int side = 0; side < 2; ++side) {
        c.count[side] = w->of->stages[r.p.side[side]->stages[0]].count;
        r.p.order[side] = read_order(in, c.count[side]);
        if (c.count[side] == 1) leaf_box(&r.p, side, 0, c.uv[side]);
    }
    const bool good = bytes_are_good(in) && take_entry(&r, &c, 0);
    for (int side = 0; side < 2; ++side) free(r.p.order[side]);
    return good;
}

bool claim_ignores(const claim *c, size_t a, size_t b)
{
    const size_t body = c->surfaces[a].body, other = c->surfaces[b].body;
    bool ignored = body == other;
    for (size_t k = 0; k < c->ignored_count; ++k)
        for (int i = 0; i < 2; ++i)
            ignored = ignored || (c->ignored[k][i] == body && c->ignored[k][1 - i] == other);
    return ignored;
}

static bool points_hold(trees *w)
{
    const point *at = w->of->points;
    pair p = {.of = w->of};
    range x[2][3], apart[3];
    for (int k = 0; k < 2; ++k) {
        if (at[k].surface >= w->of->surface_count)
            return bytes_refuse(w->in, "a point is on no surface");
        p.side[k] = &w->of->surfaces[at[k].surface];
        if (at[k].piece >= w->of->stages[p.side[k]->stages[0]].count || !leaf_point(&p, k, x[k]))
            return bytes_refuse(w->in, "a point is outside of its surface, or has no value");
    }
    if (claim_ignores(w->of, at[0].surface, at[1].surface))
        return bytes_refuse(w->in, "the points are of bodies that are not tested");
    for (int i = 0; i < 3; ++i) apart[i] = range_sub(x[1][i], x[0][i]);
    const range within = range_of(w->of->within), square = range_square(apart);
    return (within.lo >= 0 && square.hi <= range_mul(within, within).lo) ||
           bytes_refuse(w->in, "the points stated are %.9g apart", sqrt(square.hi));
}

/* The first surface behind those of the body of surface k, which stand together. */
static size_t behind(const claim *s, size_t k)
{
    const size_t body = s->surfaces[k].body;
    while (k < s->surface_count && s->surfaces[k].body == body) ++k;
    return k;
}

bool trees_hold(trees *w)
{
    const claim *s = w->of;
    if (s->has_points && !points_hold(w)) return false;
    for (size_t a = 0; a < s->surface_count; a = behind(s, a))
        for (size_t b = behind(s, a); b < s->surface_count; b = behind(s, b))
            for (size_t i = a; i < behind(s, a) && !claim_ignores(s, a, b); ++i)
                for (size_t j = b; j < behind(s, b); ++j)
                    if (!take_pair(w, i, j)) return false;
    w->in->copy = NULL; /* of the checksum, which guards against accidents and is not compared */
    for (int k = 0; k < 32; ++k) bytes_next(w->in);
    return bytes_are_good(w->in) &&
           (getc(w->in->file) == EOF || bytes_refuse(w->in, "bytes follow the checksum"));
}
