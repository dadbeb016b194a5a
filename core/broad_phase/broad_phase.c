/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/broad_phase.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/rounding.h"

/* Whether two boxes are apart. A NaN compares false, so that it is never apart. */
PAD_COVERS(2, 1); /* one difference */
static bool apart(double above, double below, double gamma_clear)
{
    return padded_lower(above - below, 2) > gamma_clear;
}

bool broad_phase_apart(const double lo[3], const double hi[3], const double other_lo[3],
                       const double other_hi[3], double gamma_clear)
{
    for (int i = 0; i < 3; ++i)
        if (apart(lo[i], other_hi[i], gamma_clear) || apart(other_lo[i], hi[i], gamma_clear))
            return true;
    return false;
}

static bool boxes_apart(const swept_box *a, const swept_box *b, double gamma_clear)
{
    return broad_phase_apart(a->lo, a->hi, b->lo, b->hi, gamma_clear);
}

/* --- The order of the sweep ------------------------------------------------------------------- */

static int by_start(const swept_box *a, const swept_box *b, int axis)
{
    if (a->lo[axis] != b->lo[axis]) return a->lo[axis] < b->lo[axis] ? -1 : 1;
    return a->owner < b->owner ? -1 : a->owner > b->owner;
}

static int by_x(const void *p, const void *q) { return by_start(p, q, 0); }
static int by_y(const void *p, const void *q) { return by_start(p, q, 1); }
static int by_z(const void *p, const void *q) { return by_start(p, q, 2); }

/* Estimates which part of all boxes' starts lies within one box's span along the axis: the mean
 * length of the finite spans, divided by the distance from the first to the last. */
static double crowding(const swept_box *boxes, size_t count, int axis)
{
    double first = INFINITY, last = -INFINITY, length = 0;
    size_t finite = 0;
    for (size_t k = 0; k < count; ++k) {
        const double lo = boxes[k].lo[axis], hi = boxes[k].hi[axis];
        if (!(hi - lo < INFINITY)) continue;
        first = lo < first ? lo : first;
        last = hi > last ? hi : last;
        length += hi - lo;
        finite += 1;
    }
    return last > first ? length / ((double)finite * (last - first)) : 1;
}

static int least_crowded(const swept_box *boxes, size_t count)
{
    int best = 0;
    double least = crowding(boxes, count, 0);
    for (int axis = 1; axis < 3; ++axis) {
        const double here = crowding(boxes, count, axis);
        if (here < least) best = axis, least = here;
    }
    return best;
}

int broad_phase_sort(swept_box *boxes, size_t count)
{
    static int (*const order[])(const void *, const void *) = {by_x, by_y, by_z};
    const int axis = least_crowded(boxes, count);
    for (size_t k = 0; k < count; ++k)
        if (!(boxes[k].lo[axis] <= boxes[k].hi[axis]))
            boxes[k].lo[axis] = -INFINITY, boxes[k].hi[axis] = INFINITY;
    qsort(boxes, count, sizeof *boxes, order[axis]);
    for (size_t k = count; k-- > 0;) {
        const bool alike = k + 1 < count && boxes[k].group == boxes[k + 1].group;
        boxes[k].beyond = alike ? boxes[k + 1].beyond : k + 1;
    }
    return axis;
}

bool broad_phase_visit_two(const swept_box *box, const swept_box *later, int axis,
                           double gamma_clear, bool *is_beyond, const broad_phase_visitor *visitor)
{
    *is_beyond = apart(later->lo[axis], box->hi[axis], gamma_clear);
    if (*is_beyond || later->group == box->group || boxes_apart(box, later, gamma_clear))
        return true;
    return visitor->visit(visitor->context, box->owner, later->owner);
}

/* Lemma. No two boxes of different groups within gamma_clear are left out. A box with a NaN along
 * the axis starts before all others and ends after them, so that the order is total. A box after
 * another in the order starts no earlier: once one is apart from box k along the axis, so are all
 * that follow. */
bool broad_phase_visit_box(const swept_box *boxes, size_t count, int axis, size_t k,
                           double gamma_clear, const broad_phase_visitor *visitor)
{
    size_t l = k + 1;
    while (l < count) {
        if (boxes[l].group == boxes[k].group) {
            l = boxes[l].beyond;
            continue;
        }
        bool is_beyond;
        if (!broad_phase_visit_two(&boxes[k], &boxes[l], axis, gamma_clear, &is_beyond, visitor))
            return false;
        if (is_beyond) break;
        ++l;
    }
    return true;
}

bool broad_phase_visit_all(const swept_box *boxes, size_t count, double gamma_clear,
                           const broad_phase_visitor *visitor)
{
    for (size_t k = 0; k < count; ++k)
        for (size_t l = k + 1; l < count; ++l)
            if (boxes[k].group != boxes[l].group &&
                !boxes_apart(&boxes[k], &boxes[l], gamma_clear) &&
                !visitor->visit(visitor->context, boxes[k].owner, boxes[l].owner))
                return false;
    return true;
}

/* --- The least distance ----------------------------------------------------------------------- */

/* Returns an upper bound of the distance of any two points of two boxes. Lemma. Along each axis the
 * points differ by at most the greater of both boxes' ends less the other's start: one rounding, of
 * the square and the sums at most three, which the root halves, and its own. */
PAD_COVERS(8, 4);
static double greatest_distance(const swept_box *a, const swept_box *b)
{
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double up = b->hi[i] - a->lo[i], down = a->hi[i] - b->lo[i];
        if (isnan(up) || isnan(down)) return NAN;
        const double most = up > down ? up : down;
        square += most * most;
    }
    return padded_upper(sqrt(square), 8) + ROOT_UNDERFLOW;
}

/* Lemma. A box after another in the order starts no earlier, so that greatest_distance is no less
 * than the difference of both starts; once that exceeds the least distance, it does so for all that
 * follow. A NaN never becomes the least. */
double broad_phase_least_distance(const swept_box *boxes, size_t count, int axis,
                                  const broad_phase_visitor *visitor)
{
    double least = INFINITY;
    for (size_t k = 0; k < count; ++k) {
        if (!visitor->next_box(visitor->context)) return INFINITY;
        for (size_t l = k + 1; l < count; ++l) {
            if (boxes[l].lo[axis] - boxes[k].lo[axis] > least) break;
            if (boxes[l].group == boxes[k].group) continue;
            const double most = greatest_distance(&boxes[k], &boxes[l]);
            if (most < least && visitor->visit(visitor->context, boxes[k].owner, boxes[l].owner))
                least = most;
        }
    }
    return least;
}
