/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/proof/proof_tree.h"

/* Trees that are moved to a cell of other times. */

typedef struct copy {
    const uint8_t *tree;
    size_t size, at;
    const proof_sink *sink; /* NULL: what is read is left out */
    uint8_t axis[6];        /* of the leaf read last that had one, */
    bool is_known;          /* which was not written */
} copy;

static void put(const copy *c, const uint8_t *bytes, size_t size)
{
    if (c->sink != NULL) c->sink->write(c->sink->context, bytes, size);
}

/* An axis that a leaf has from one that was left out is written in full. */
static bool copy_leaf(copy *c, unsigned op)
{
    uint8_t bytes[7] = {PROOF_OP_AXIS};
    if (op == PROOF_OP_ALONE) return put(c, &(uint8_t){PROOF_OP_ALONE}, 1), true;
    if (op == PROOF_OP_AXIS && c->size - c->at < sizeof c->axis) return false;
    for (size_t k = 0; k < sizeof c->axis && op == PROOF_OP_AXIS; ++k)
        c->axis[k] = c->tree[c->at++];
    if (op == PROOF_OP_SAME && c->is_known) return put(c, &(uint8_t){PROOF_OP_SAME}, 1), true;
    for (size_t k = 0; k < sizeof c->axis; ++k) bytes[1 + k] = c->axis[k];
    put(c, bytes, sizeof bytes);
    c->is_known = c->sink != NULL;
    return true;
}

static bool copy_entry(copy *c, double lo, double hi, double from, double to);

static bool skip_entry(copy *c)
{
    const proof_sink *sink = c->sink;
    c->sink = NULL;
    const bool good = copy_entry(c, 0, 1, 0, 1);
    c->sink = sink;
    return good;
}

static bool copy_time(copy *c, double lo, double hi, double from, double to)
{
    if (c->size - c->at < 2) return false;
    const unsigned k = (unsigned)c->tree[c->at] << 8 | c->tree[c->at + 1];
    const double t = proof_place(lo, hi, k), own = floor((t - from) / (to - from) * 65536);
    c->at += 2;
    if (!(own >= 1)) return skip_entry(c) && copy_entry(c, t, hi, from, to);
    if (!(own < 65536)) return copy_entry(c, lo, t, from, to) && skip_entry(c);
    const double split = proof_place(from, to, (unsigned)own);
    put(c, (uint8_t[]){PROOF_OP_TIME, (uint8_t)((unsigned)own >> 8), (uint8_t)own}, 3);
    return copy_entry(c, lo, t, from, split) && copy_entry(c, t, hi, split, to);
}

static bool copy_entry(copy *c, double lo, double hi, double from, double to)
{
    if (c->at == c->size) return false;
    const uint8_t op = c->tree[c->at++];
    if (op == PROOF_OP_TIME) return copy_time(c, lo, hi, from, to);
    if (op > PROOF_OP_TIME) return copy_leaf(c, op);
    put(c, &op, 1);
    return copy_entry(c, lo, hi, from, to) && copy_entry(c, lo, hi, from, to);
}

bool proof_tree_copy(const uint8_t *tree, size_t size, double lo, double hi, double from, double to,
                     const proof_sink *sink)
{
    copy c = {.tree = tree, .size = size, .sink = sink};
    return copy_entry(&c, lo, hi, from, to) && c.at == size;
}
