/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/proof/proof_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE = UINT32_MAX };

struct proof_trees {
    const proof_log *log;
    uint32_t *child; /* of each record, the one made last */
    uint32_t *next;  /* of the same parent or candidate, made before */
    uint32_t *root;  /* of each candidate */
    uint32_t roots;
};

/* --- Who was made of whom --------------------------------------------------------------------- */

static uint32_t count_roots(const proof_log *log)
{
    uint32_t count = 0;
    for (size_t k = 0; k < log->count; ++k)
        if (log->at[k].step == PROOF_ROOT && log->at[k].parent >= count)
            count = log->at[k].parent + 1;
    return count;
}

proof_trees *proof_trees_new(const proof_log *log)
{
    proof_trees *t = malloc(sizeof *t);
    if (t == NULL) return NULL;
    const uint32_t roots = count_roots(log);
    *t = (proof_trees){log, malloc((log->count + 1) * sizeof *t->child),
                       malloc((log->count + 1) * sizeof *t->next),
                       malloc(((size_t)roots + 1) * sizeof *t->root), roots};
    if (t->child == NULL || t->next == NULL || t->root == NULL) return proof_trees_free(t), NULL;
    for (uint32_t k = 0; k < roots; ++k) t->root[k] = NONE;
    for (uint32_t k = 0; k < log->count; ++k) {
        const proof_record *r = &log->at[k];
        uint32_t *list = r->step == PROOF_ROOT ? &t->root[r->parent] : &t->child[r->parent];
        t->child[k] = NONE;
        t->next[k] = *list;
        *list = k;
    }
    return t;
}

void proof_trees_free(proof_trees *t)
{
    if (t == NULL) return;
    free(t->child);
    free(t->next);
    free(t->root);
    free(t);
}

/* --- Writing ---------------------------------------------------------------------------------- */

typedef struct writer {
    const proof_trees *trees;
    const proof_sink *to;
    int16_t axis[3]; /* of the last leaf that had one */
    bool rests;
} writer;

static void put(const writer *w, int op)
{
    w->to->write(w->to->context, &(uint8_t){(uint8_t)op}, 1);
}

static void put_16(const writer *w, uint16_t x)
{
    const uint8_t bytes[2] = {(uint8_t)(x >> 8), (uint8_t)x};
    w->to->write(w->to->context, bytes, sizeof bytes);
}

static void put_leaf(writer *w, const proof_record *r)
{
    const bool has_axis = r != NULL && (r->axis[0] | r->axis[1] | r->axis[2]) != 0;
    if (!has_axis) {
        put(w, PROOF_OP_ALONE);
    } else if (memcmp(w->axis, r->axis, sizeof w->axis) == 0) {
        put(w, PROOF_OP_SAME);
    } else {
        put(w, PROOF_OP_AXIS);
        for (int i = 0; i < 3; ++i) put_16(w, (uint16_t)r->axis[i]);
        memcpy(w->axis, r->axis, sizeof w->axis);
    }
}

/* Splits the cell at k / 65536 of its time, 0 < k < 65536, and returns where. */
static double put_time(const writer *w, double lo, double hi, double k)
{
    put(w, PROOF_OP_TIME);
    put_16(w, (uint16_t)k);
    return proof_place(lo, hi, (unsigned)k);
}

static double part_of(double lo, double hi, double t) { return (t - lo) / (hi - lo) * 65536; }

static void put_record(writer *w, uint32_t index, double lo, double hi);

/* Returns the child of a record that is one half of it; NONE: there is none. The last child says
 * how the record was divided, since the search gave up earlier ones. */
static uint32_t half_of(const writer *w, uint32_t index, int half)
{
    const proof_trees *t = w->trees;
    const unsigned wanted = (t->log->at[t->child[index]].step & ~1u) | (unsigned)half;
    for (uint32_t k = t->child[index]; k != NONE; k = t->next[k])
        if (t->log->at[k].step == wanted) return k;
    return NONE;
}

static void put_halves(writer *w, uint32_t index, double lo, double hi)
{
    const proof_trees *t = w->trees;
    put(w, PROOF_OP_SPLIT + (int)(t->log->at[t->child[index]].step - PROOF_HALF) / 2);
    for (int half = 0; half < 2; ++half) {
        const uint32_t k = half_of(w, index, half);
        if (k != NONE)
            put_record(w, k, lo, hi);
        else
            put_leaf(w, &t->log->at[index]);
    }
}

/* Writes the parts of a window, of which the later may have been made first or alone. */
static void put_spans(writer *w, uint32_t index, double lo, double hi)
{
    const proof_trees *t = w->trees;
    const proof_record *at = t->log->at;
    uint32_t early = t->child[index], late = t->next[early];
    if (late != NONE && at[late].step != PROOF_SPAN) late = NONE;
    if (late != NONE && at[late].lo < at[early].lo) {
        const uint32_t kept = early;
        early = late, late = kept;
    }
    const double k = late == NONE ? 65536 : round(part_of(lo, hi, at[late].lo));
    if (!(k < 65536)) return put_record(w, early, lo, hi);
    if (!(k >= 1)) return put_record(w, late, lo, hi);
    const double split = put_time(w, lo, hi, k);
    put_record(w, early, lo, split);
    put_record(w, late, split, hi);
}

static void put_inner(writer *w, uint32_t index, double lo, double hi)
{
    const uint32_t child = w->trees->child[index];
    const unsigned step = child == NONE ? PROOF_ROOT : w->trees->log->at[child].step;
    if (step == PROOF_ROOT)
        put_leaf(w, &w->trees->log->at[index]);
    else if (step == PROOF_AGAIN)
        put_record(w, child, lo, hi);
    else if (step == PROOF_SPAN)
        put_spans(w, index, lo, hi);
    else
        put_halves(w, index, lo, hi);
}

/* Writes a record over the times [lo, hi]. What the test cut off of these times is a leaf. Splits
 * are rounded outward, so that the window that was left is inside of the part that goes on. */
static void put_record(writer *w, uint32_t index, double lo, double hi)
{
    const proof_record *r = &w->trees->log->at[index];
    if (r->lo > r->hi) return put_leaf(w, r);
    if (w->rests || !(lo < hi)) return put_inner(w, index, lo, hi);
    if (r->lo >= hi || r->hi <= lo) return put_leaf(w, r);
    double k = floor(part_of(lo, hi, r->lo));
    if (k >= 65536) return put_leaf(w, r);
    if (k >= 1) {
        lo = put_time(w, lo, hi, k);
        put_leaf(w, r);
    }
    k = lo < hi ? ceil(part_of(lo, hi, r->hi)) : 65536;
    if (!(k < 65536)) return put_inner(w, index, lo, hi);
    put_inner(w, index, lo, put_time(w, lo, hi, k >= 1 ? k : 1));
    put_leaf(w, r);
}

void proof_trees_write(const proof_trees *trees, uint32_t candidate, double lo, double hi,
                       bool rests, const proof_sink *to)
{
    writer w = {.trees = trees, .to = to, .rests = rests};
    const uint32_t root = candidate < trees->roots ? trees->root[candidate] : NONE;
    if (root == NONE)
        put_leaf(&w, NULL);
    else
        put_record(&w, root, lo, hi);
}
