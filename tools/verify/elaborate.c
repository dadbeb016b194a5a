/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/elaborate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/sha256.h"
#include "tools/kernel/kernel.h"
#include "tools/verify/aim.h"
#include "tools/verify/cloud.h"
#include "tools/verify/sides.h"

enum { DEPTH_MAX = 120, HELD = 7 }; /* HELD: bytes of a leaf */
enum { CREDIT = 512, CREDIT_A_CELL = 8, CREDIT_A_LEAF = 64, CREDIT_CLOUD = 8192 };

typedef struct elaboration {
    FILE *to;
    sha256 hash;
    bool failed;            /* to write */
    uint8_t held[HELD + 1]; /* bytes that are read and perhaps a leaf's */
    size_t held_count;
    trees *w;
    uint64_t tree;      /* the last one whose header was begun */
    int counts;         /* of its header that are read; 3: that of maps, which is written as 0 */
    uint64_t leaf_tree; /* of the leaf written last, and */
    int16_t last[3];    /* its axis */
    unsigned long effort, cells; /* of a leaf */
    elaborated *found;
    long credit, cloud_credit;        /* enclosures that may be in vain; of them, for points */
    void (*progress)(uint64_t bytes); /* NULL: no progress is reported */
    sides sides;
    cloud cloud;
} elaboration;

/* --- Writing ---------------------------------------------------------------------------------- */

static void put(elaboration *e, const uint8_t *from, size_t size)
{
    sha256_add(&e->hash, from, size);
    if (fwrite(from, 1, size, e->to) != size) e->failed = true;
}

static void put_held(elaboration *e, size_t count)
{
    put(e, e->held, count);
    e->held_count -= count;
    memmove(e->held, e->held + count, e->held_count);
}

/* Takes a byte that was read. The count of maps that a header leaves out becomes 0. */
static void copy(void *context, uint8_t byte)
{
    elaboration *e = context;
    if (e->tree != e->w->pairs) e->tree = e->w->pairs, e->counts = 0;
    const bool is_count = e->tree > 0 && e->counts < 3, ends = byte < 128;
    const bool is_left_out = is_count && e->counts == 2;
    if (is_count && ends) e->counts += 1;
    if (is_left_out && !ends) return;
    if (e->held_count == HELD) put_held(e, 1);
    e->held[e->held_count++] = is_left_out ? 0 : byte;
}

static void put_leaf(elaboration *e, const int16_t axis[3])
{
    uint8_t entry[HELD] = {TREES_AXIS};
    const bool is_same = e->leaf_tree == e->tree && memcmp(axis, e->last, sizeof e->last) == 0;
    for (int i = 0; i < 3; ++i) {
        entry[1 + 2 * i] = (uint8_t)((uint16_t)axis[i] >> 8);
        entry[2 + 2 * i] = (uint8_t)axis[i];
    }
    if (is_same) entry[0] = TREES_SAME;
    put(e, entry, is_same ? 1 : HELD);
    memcpy(e->last, axis, sizeof e->last);
    e->leaf_tree = e->tree;
    e->found->leaves += 1;
}

static void put_sides(elaboration *e, const int16_t axis[3])
{
    uint8_t entry[HELD] = {TREES_SIDES}, entries[SIDES_PARTS];
    for (int i = 0; i < 3; ++i) {
        entry[1 + 2 * i] = (uint8_t)((uint16_t)axis[i] >> 8);
        entry[2 + 2 * i] = (uint8_t)axis[i];
    }
    put(e, entry, HELD);
    for (int side = 0; side < 2; ++side) put(e, entries, sides_write(&e->sides, side, entries));
    memcpy(e->last, axis, sizeof e->last);
    e->leaf_tree = e->tree;
    e->found->leaves += 1;
}

static void put_split(elaboration *e, const tree *r, const aim_cut *by)
{
    const uint8_t side[1] = {(uint8_t)(2 * by->side + (int)by->along)};
    const uint8_t time[3] = {TREES_TIME, 0x80, 0};
    const uint8_t clock[4] = {TREES_CLOCK, (uint8_t)by->along, 0x80, 0};
    if (by->side < 2)
        put(e, side, sizeof side);
    else if (by->along == r->main)
        put(e, time, sizeof time);
    else
        put(e, clock, sizeof clock);
}

/* --- Cells ------------------------------------------------------------------------------------ */

static bool holds(elaboration *e, tree *r, const cell *c, const int16_t axis[3])
{
    bound b[2];
    e->found->tests += 1;
    for (int side = 0; side < 2; ++side) {
        b[side] = (bound){.p = &r->p, .c = c, .n = {axis[0], axis[1], axis[2]}};
        if (!leaf_visit(&r->p, c, side, leaf_add, &b[side])) return false;
    }
    return leaf_holds(&b[0], &b[1]);
}

static bool give_up(tree *r, const char *why)
{
    r->p.why = why;
    return false;
}

/* The clock whose values are the greatest share of their range. */
static size_t widest_clock(const tree *r, const cell *c)
{
    size_t best = r->main;
    double most = 0;
    for (size_t k = 0; k < r->w->of->clock_count; ++k) {
        const range all = r->w->of->clocks[k].all, here = c->clocks[k];
        const double share = all.hi > all.lo ? (here.hi - here.lo) / (all.hi - all.lo) : 0;
        if (share > most) most = share, best = k;
    }
    return best;
}

/* Writes a cell as a leaf with this axis, if there are parts of its sides that do. */
static bool try_sides(elaboration *e, tree *r, const cell *c, const int16_t axis[3])
{
    if (e->credit <= 0) return false;
    const bool good = sides_find(&e->sides, &r->p, c, axis);
    e->found->tests += e->sides.tests;
    e->credit += good ? CREDIT_A_LEAF : -(long)e->sides.tests;
    if (good) put_sides(e, axis);
    return good;
}

/* Seeks an axis by points of both sides, or a clock that is to be divided. These help where motions
 * are what is too wide. Where the sides are, cells would become ever shorter in time for nothing:
 * so a leaf has credit for some of them only. */
static bool write_by_points(elaboration *e, tree *r, const cell *c, aim_cut *cut)
{
    cloud *l = &e->cloud;
    cloud_find(l, &r->p, c);
    e->found->tests += l->tests;
    e->cloud_credit -= (long)l->tests;
    if (l->room > 0 && try_sides(e, r, c, l->axis)) {
        e->cloud_credit += CREDIT_A_LEAF;
        return true;
    }
    if (l->always > 2 * fmax(l->room, 0)) *cut = (aim_cut){2, widest_clock(r, c)};
    return false;
}

/* Writes a cell as a leaf whose sides are divided; false: changes by what the cell is to be divided
 * instead. The axis of the leaf before is tried first, if there is one. */
static bool write_sides(elaboration *e, tree *r, const cell *c, const int16_t axis[3],
                        const int16_t other[3], aim_cut *cut)
{
    const bool is_some = axis[0] != 0 || axis[1] != 0 || axis[2] != 0;
    e->sides.clock = -1;
    e->credit += CREDIT_A_CELL;
    if (is_some && try_sides(e, r, c, axis)) return true;
    const int clock = e->sides.clock;
    if (memcmp(axis, other, 3 * sizeof *axis) != 0 && try_sides(e, r, c, other)) return true;
    if (e->cloud_credit <= 0) return false;
    if (clock >= 0) e->sides.clock = clock;
    if (e->sides.clock < 0 && write_by_points(e, r, c, cut)) return true;
    if (e->sides.clock >= 0) *cut = (aim_cut){2, (size_t)e->sides.clock};
    return false;
}

/* Writes a cell as a leaf, or as a tree. */
static bool write_cell(elaboration *e, tree *r, const cell *c, const int16_t hint[3], int depth)
{
    aim found;
    cell half[2];
    if (++e->cells > e->effort)
        return give_up(r, "its effort ran out, which does not say that it is false: try a greater "
                          "--effort");
    if (depth > DEPTH_MAX) return give_up(r, "it is divided too often");
    if (e->progress != NULL) e->progress(e->w->in->at);
    const int16_t *known[2] = {e->leaf_tree == e->tree ? e->last : hint, hint};
    aim_take(&r->p, c, known, &found);
    for (int k = 0; k < found.count; ++k)
        if (holds(e, r, c, found.axes[k])) {
            put_leaf(e, found.axes[k]);
            return true;
        }
    if (write_sides(e, r, c, known[0], found.best, &found.cut)) return true;
    if (found.cut.side < 0) return give_up(r, "it is too small to be divided");
    const size_t along = found.cut.along;
    const range all = c->clocks[found.cut.side == 2 ? along : 0];
    put_split(e, r, &found.cut);
    trees_split(&r->p, c, found.cut.side, along, all.lo + (all.hi - all.lo) * 0.5, half);
    return write_cell(e, r, &half[0], hint, depth + 1) &&
           write_cell(e, r, &half[1], hint, depth + 1);
}

static bool take_leaf(void *context, tree *r, const cell *c, unsigned op)
{
    elaboration *e = context;
    int16_t hint[3] = {0, 0, 0};
    if (op == TREES_SIDES) return bytes_refuse(e->w->in, "it has been elaborated already");
    const size_t size = op == TREES_AXIS ? HELD : 1;
    put_held(e, e->held_count - size);
    e->held_count = 0;
    e->cells = 0;
    e->credit = CREDIT, e->cloud_credit = CREDIT_CLOUD;
    for (int i = 0; i < 3 && op != TREES_ALONE; ++i) hint[i] = (int16_t)r->axis[i];
    return write_cell(e, r, c, hint, 0);
}

void claim_free(claim *c)
{
    for (size_t k = 0; k < c->stage_count; ++k) {
        for (size_t i = 0; i < c->stages[k].count; ++i) {
            const piece *p = &c->stages[k].pieces[i];
            for (size_t j = 0; j < p->count; ++j) free(p->parts[j].f);
            free(p->parts);
        }
        free(c->stages[k].pieces);
        free(c->stages[k].last.value);
    }
    for (size_t k = 0; k < c->surface_count; ++k) free(c->surfaces[k].stages);
    for (size_t k = 0; k < c->body_count; ++k) free(c->bodies[k]);
    for (size_t k = 1; k < c->clock_count; ++k) free(c->clocks[k].name);
    free(c->stages);
    free(c->surfaces);
    free(c->bodies);
    free(c->ignored);
}

bool elaborate(FILE *from, FILE *to, unsigned long effort, void progress(uint64_t bytes),
               elaborated *found)
{
    uint8_t digest[SHA256_BYTES];
    claim c;
    trees w = {.of = &c, .leaf = take_leaf};
    elaboration e = {.to = to, .w = &w, .effort = effort, .found = found, .progress = progress};
    bytes in = {.file = from, .copy = copy, .context = &e};
    w.in = &in, w.context = &e;
    *found = (elaborated){.leaves = 0};
    sha256_begin(&e.hash);
    bool good = claim_read(&c, &in) && trees_hold(&w);
    claim_free(&c);
    put_held(&e, e.held_count);
    sha256_end(&e.hash, digest);
    if (fwrite(digest, 1, sizeof digest, to) != sizeof digest) e.failed = true;
    if (good && e.failed) good = bytes_refuse(&in, "a temporary file cannot be written");
    found->leaves_before = w.leaves;
    found->at = in.at;
    memcpy(found->why, in.fault, sizeof in.fault);
    return good;
}
