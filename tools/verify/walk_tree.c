/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/walk_internal.h"

#include <math.h>

enum { DEPTH_MAX = 4000, LEAVES_A_SHARE = 16 };

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

bool walk_take_tree(pair *p, const cell *c)
{
    const watch *told = p->is_said ? p->w->watch : NULL;
    if (told != NULL) told->begun(told->context);
    const bool good = take_entry(p, c, 0);
    if (good && told != NULL) told->ended(told->context);
    return good;
}
