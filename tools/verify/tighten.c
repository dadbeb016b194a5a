/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/tighten.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

enum { AXIS_BYTES = 6 };

/* An axis as a leaf names it; not `named`: none. */
typedef struct hint {
    bool named;
    int16_t x[3];
} hint;

/* A split whose parts are not both read, or a part of a tree that is. */
typedef struct part_of_tree {
    size_t at;   /* where it begins in `tree` */
    hint before; /* of the leaf before it */
    bool is_leaf;
    hint axis;                 /* of a leaf, and what */
    unsigned long tests, cast; /* proving it took */
} part_of_tree;

struct tightening {
    walk *of;
    FILE *to;
    sha256 hash;
    watch watch;
    uint8_t *tree; /* what is written of the tree that is being read */
    size_t size, room;
    part_of_tree *parts;
    size_t count, parts_room;
    hint last;          /* axis of the leaf written last in this tree */
    unsigned long cast; /* by the prover when the part before ended */
    uint64_t leaves, before;
    bool failed;
};

/* --- Writing ---------------------------------------------------------------------------------- */

static void put(tightening *g, const uint8_t *bytes, size_t size)
{
    sha256_add(&g->hash, bytes, size);
    if (fwrite(bytes, 1, size, g->to) != size) g->failed = true;
}

static void put_byte(void *context, uint8_t byte) { put(context, &byte, 1); }

static void add_bytes(tightening *g, const uint8_t *bytes, size_t size)
{
    for (size_t k = 0; k < size && !g->failed; ++k) {
        uint8_t *grown = array_reserve(g->tree, g->size, &g->room, sizeof *grown);
        g->failed = grown == NULL;
        if (g->failed) return;
        g->tree = grown;
        grown[g->size++] = bytes[k];
    }
}

static bool is_same(const hint *a, const hint *b)
{
    return a->named == b->named && (!a->named || memcmp(a->x, b->x, sizeof a->x) == 0);
}

static void add_leaf(tightening *g, const hint *axis)
{
    uint8_t bytes[1 + AXIS_BYTES] = {WALK_AXIS};
    for (int i = 0; i < 3; ++i) {
        bytes[1 + 2 * i] = (uint8_t)((uint16_t)axis->x[i] >> 8);
        bytes[2 + 2 * i] = (uint8_t)axis->x[i];
    }
    if (is_same(axis, &g->last)) bytes[0] = WALK_SAME;
    if (!axis->named) bytes[0] = WALK_ALONE;
    add_bytes(g, bytes, bytes[0] == WALK_AXIS ? sizeof bytes : 1);
    if (axis->named) g->last = *axis;
    g->leaves += 1;
}

static part_of_tree *add_part(tightening *g)
{
    part_of_tree *grown = array_reserve(g->parts, g->count, &g->parts_room, sizeof *grown);
    if (grown == NULL) g->failed = true;
    if (grown == NULL) return NULL;
    g->parts = grown;
    grown[g->count] = (part_of_tree){.at = g->size, .before = g->last};
    return &grown[g->count++];
}

/* --- Proving ---------------------------------------------------------------------------------- */

/* Proves a cell with this axis, alone, by no more work than `most` took. */
static bool try_axis(tightening *g, prover *p, const cell *c, const hint *axis, part_of_tree *most)
{
    const unsigned long allowed = p->tests_most, before = p->areas[0].cast + p->areas[1].cast;
    for (int i = 0; i < 3; ++i) p->axis[i] = axis->named ? axis->x[i] : 0;
    p->tests_most = most->tests;
    prover_forget(p);
    const bool proved = prove_apart(p, c);
    p->tests_most = allowed;
    g->cast = p->areas[0].cast + p->areas[1].cast;
    if (!proved || g->cast - before > most->cast) return false;
    most->axis = *axis;
    most->tests = p->tests;
    most->cast = g->cast - before;
    return true;
}

/* Writes a leaf, with the shortest axis that does. */
static void end_leaf(tightening *g, prover *p, const cell *c, part_of_tree *leaf)
{
    static const hint none;
    leaf->is_leaf = true;
    if (leaf->axis.named && !is_same(&leaf->axis, &g->last) &&
        !(g->last.named && try_axis(g, p, c, &g->last, leaf)))
        try_axis(g, p, c, &none, leaf);
    add_leaf(g, &leaf->axis);
}

/* --- What the walk tells ---------------------------------------------------------------------- */

static void begun(void *context)
{
    tightening *g = context;
    g->of->in->copy = NULL;
    g->size = g->count = 0;
    g->last.named = false;
    g->cast = 0;
}

static void split_read(void *context, const uint8_t *bytes, size_t size)
{
    tightening *g = context;
    add_part(g);
    add_bytes(g, bytes, size);
}

static void leaf_read(void *context, prover *p, const cell *c, bool named)
{
    tightening *g = context;
    part_of_tree *leaf = add_part(g);
    if (leaf == NULL) return;
    leaf->tests = p->tests;
    leaf->cast = p->areas[0].cast + p->areas[1].cast - g->cast;
    for (int i = 0; i < 3; ++i) leaf->axis.x[i] = (int16_t)p->axis[i];
    leaf->axis.named = named && (p->axis[0] != 0 || p->axis[1] != 0 || p->axis[2] != 0);
    g->cast += leaf->cast;
    g->before += 1;
    end_leaf(g, p, c, leaf);
}

/* Two leaves become one if the prover parts their cell with the axis of either. */
static void joined(void *context, prover *p, const cell *c)
{
    tightening *g = context;
    if (g->failed) return;
    const part_of_tree *half = &g->parts[g->count - 2];
    part_of_tree *whole = &g->parts[g->count - 3];
    const hint axis[2] = {half[0].axis, half[1].axis};
    bool proved = false;
    g->count -= 2;
    if (!half[0].is_leaf || !half[1].is_leaf) return;
    whole->tests = half[0].tests + half[1].tests - 1;
    whole->cast = half[0].cast + half[1].cast;
    for (int k = 0; k < 2 && !proved; ++k)
        proved = (k == 0 || !is_same(&axis[0], &axis[1])) && try_axis(g, p, c, &axis[k], whole);
    if (!proved) return;
    g->size = whole->at;
    g->last = whole->before;
    g->leaves -= 2;
    end_leaf(g, p, c, whole);
}

static void ended(void *context)
{
    tightening *g = context;
    put(g, g->tree, g->size);
    g->of->in->copy = put_byte;
}

/* --- The whole -------------------------------------------------------------------------------- */

tightening *tighten_begin(walk *w, FILE *to)
{
    tightening *g = calloc(1, sizeof *g);
    if (g == NULL) return NULL;
    g->of = w;
    g->to = to;
    g->watch = (watch){g, begun, split_read, leaf_read, joined, ended};
    sha256_begin(&g->hash);
    w->watch = &g->watch;
    w->in->copy = put_byte;
    w->in->copy_context = g;
    return g;
}

bool tighten_end(tightening *g, uint64_t *leaves)
{
    uint8_t digest[SHA256_BYTES];
    sha256_end(&g->hash, digest);
    if (fwrite(digest, 1, sizeof digest, g->to) != sizeof digest || fflush(g->to) != 0)
        g->failed = true;
    *leaves = g->of->leaves - g->before + g->leaves;
    return !g->failed;
}

void tighten_free(tightening *g)
{
    if (g == NULL) return;
    free(g->tree);
    free(g->parts);
    free(g);
}
