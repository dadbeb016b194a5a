/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/broad_phase.h"

#include <stdlib.h>

#include "core/base/rounding.h"

static int by_start(const void *p, const void *q)
{
    const swept_box *a = p, *b = q;
    if (a->lo[0] < b->lo[0]) return -1;
    if (a->lo[0] > b->lo[0]) return 1;
    return a->owner < b->owner ? -1 : 1;
}

/* Written so that a NaN is never apart. */
PAD_COVERS(2, 1); /* one difference */
static bool apart(double above, double below, double clearance)
{
    return padded_lower(above - below, 2) > clearance;
}

static bool boxes_apart(const swept_box *a, const swept_box *b, double clearance)
{
    for (int i = 0; i < 3; ++i)
        if (apart(a->lo[i], b->hi[i], clearance) || apart(b->lo[i], a->hi[i], clearance))
            return true;
    return false;
}

bool broad_phase_visit(swept_box *boxes, size_t count, double clearance,
                       const broad_phase_visitor *visitor)
{
    /* a NaN would break the order: such a box starts before all others and ends after them */
    for (size_t k = 0; k < count; ++k)
        if (!(boxes[k].lo[0] <= boxes[k].hi[0])) {
            boxes[k].lo[0] = -1.0 / 0.0;
            boxes[k].hi[0] = 1.0 / 0.0;
        }
    qsort(boxes, count, sizeof *boxes, by_start);
    for (size_t k = 0; k < count; ++k) {
        if (!visitor->next_box(visitor->context)) return false;
        for (size_t l = k + 1; l < count; ++l) {
            if (apart(boxes[l].lo[0], boxes[k].hi[0], clearance)) break;
            if (boxes_apart(&boxes[k], &boxes[l], clearance)) continue;
            if (!visitor->visit(visitor->context, boxes[k].owner, boxes[l].owner)) return false;
        }
    }
    return true;
}
