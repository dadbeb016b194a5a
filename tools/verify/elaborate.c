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
#include "tools/verify/sides.h"

enum { DEPTH_MAX = 120, HELD = 7, AXIS_SIZE = 3 * sizeof(int16_t) }; /* HELD: bytes of a leaf */
enum { CREDIT = 512, CREDIT_A_CELL = 4, CREDIT_A_LEAF = 64 };

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
    sides sides;
    long credit; /* enclosures that may be in vain for sides that are divided */
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
    bound b[2] = {{.n = {axis[0], axis[1], axis[2]}}, {.n = {axis[0], axis[1], axis[2]}}};
    e->found->tests += 1;
    for (int side = 0; side < 2; ++side)
        if (!leaf_visit(&r->p, c, side, leaf_add, &b[side])) return false;
    return leaf_holds(&r->p, c, &b[0], &b[1]);
}

static bool give_up(tree *r, const char *why)
{
    r->p.why = why;
    return false;
}

static bool is_among(const int16_t *const axes[3], int count, const int16_t axis[3])
{
    bool found = axis[0] == 0 && axis[1] == 0 && axis[2] == 0;
    for (int k = 0; k < count; ++k) found = found || memcmp(axes[k], axis, AXIS_SIZE) == 0;
    return found;
}

/* Writes a cell as a leaf whose sides are divided; false: changes by what the cell is to be divided
 * instead. */
static bool write_sides(elaboration *e, tree *r, const cell *c, const int16_t *const axes[3],
                        aim_cut *cut)
{
    e->credit += CREDIT_A_CELL;
    for (int k = 0; k < 3 && e->credit > 0; ++k) {
        if (is_among(axes, k, axes[k])) continue;
        const bool good = sides_find(&e->sides, &r->p, c, axes[k]);
        e->found->tests += e->sides.tests;
        e->credit += good ? CREDIT_A_LEAF : -(long)e->sides.tests;
        if (good) {
            put_sides(e, axes[k]);
            return true;
        }
        if (e->sides.clock >= 0) *cut = (aim_cut){2, (size_t)e->sides.clock};
    }
    return false;
}

/* Writes a cell as a leaf, or as a tree. */
static bool write_cell(elaboration *e, tree *r, const cell *c, const int16_t hint[3], int depth)
{
    aim found;
    cell half[2];
    if (++e->cells > e->effort || depth > DEPTH_MAX)
        return give_up(r, "it is not proved within the effort allowed");
    const int16_t *known[2] = {e->leaf_tree == e->tree ? e->last : hint, hint};
    aim_take(&r->p, c, known, &found);
    for (int k = 0; k < found.count; ++k)
        if (holds(e, r, c, found.axes[k])) {
            put_leaf(e, found.axes[k]);
            return true;
        }
    if (write_sides(e, r, c, (const int16_t *const[3]){hint, known[0], found.best}, &found.cut))
        return true;
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
    e->credit = CREDIT;
    for (int i = 0; i < 3 && op != TREES_ALONE; ++i) hint[i] = (int16_t)r->axis[i];
    return write_cell(e, r, c, hint, 0);
}

bool elaborate(FILE *from, FILE *to, unsigned long effort, elaborated *found)
{
    uint8_t digest[SHA256_BYTES];
    claim c;
    trees w = {.of = &c, .leaf = take_leaf};
    elaboration e = {.to = to, .w = &w, .effort = effort, .found = found};
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
