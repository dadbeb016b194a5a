/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/strips.h"

#include <math.h>

#include "core/base/rounding.h"

/* Fewer strips than this would leave out too few boxes; more take memory for nothing. */
enum { STRIPS_LEAST = 4, STRIPS_MOST = 1 << 16 };

/* --- Which strips a box lies in --------------------------------------------------------------- */

/* The second axis and its division. */
typedef struct division {
    int axis;
    double from, per_length; /* where the first strip starts; strips per length */
    double reach;            /* added below each box, >= the gap of boxes that are near; length */
    size_t count;
} division;

/* Returns the strip of a coordinate that is no NaN; those beyond the ends count to the first or
 * last. It never falls when x rises, since no rounding reverses an order. */
static size_t strip_at(const division *d, double x)
{
    const double at = (x - d->from) * d->per_length;
    if (!(at > 0)) return 0;
    return at < (double)d->count ? (size_t)at : d->count - 1;
}

/* Finds the strips of a box. False: it is wide.
 *
 * Lemma. If two boxes that are not wide are near each other, they have a strip in common. Near
 * means that padded_lower(fl(lo - hi), 2) <= gamma_clear for the start of each and the end of the
 * other, so lo - hi <= reach = padded_upper(gamma_clear, 8): a pad of two units and three roundings
 * are less than a pad of 8. Hence lo - reach <= hi exactly, and fl(lo - reach) <= hi: the first
 * strip of each is at most the last of the other. */
PAD_COVERS(8, 2 + 3);
static bool strips_of(const division *d, const swept_box *box, size_t *first, size_t *last)
{
    const double lo = box->lo[d->axis] - d->reach, hi = box->hi[d->axis];
    if (!(lo <= hi)) return false;
    *first = strip_at(d, lo);
    *last = strip_at(d, hi);
    return *last - *first < STRIPS_OF_BOX;
}

/* Divides the span of the starts along `axis` into strips of about one mean box and the reach. */
static division divide(const swept_box *boxes, size_t count, int axis, double reach)
{
    double first = INFINITY, last = -INFINITY, length = 0;
    size_t finite = 0;
    for (size_t k = 0; k < count; ++k) {
        const double lo = boxes[k].lo[axis], hi = boxes[k].hi[axis];
        if (!(hi - lo >= 0 && hi - lo < INFINITY)) continue;
        first = lo < first ? lo : first;
        last = hi > last ? hi : last;
        length += hi - lo;
        finite += 1;
    }
    const double width = finite > 0 ? length / (double)finite + reach : INFINITY;
    const double wanted = (last - first) / width;
    division d = {.axis = axis, .from = first - reach, .reach = reach};
    if (!(wanted >= STRIPS_LEAST && wanted < INFINITY)) return d;
    d.count = wanted < STRIPS_MOST ? (size_t)wanted : STRIPS_MOST;
    d.per_length = (double)d.count / (last - first);
    return d;
}

/* --- Making ----------------------------------------------------------------------------------- */

static bool allocate(strips *s, size_t boxes)
{
    s->start = arena_store_zeroed(s->store, (s->count + 2) * sizeof *s->start);
    s->length = arena_store_room(s->store, boxes);
    s->first = arena_store_room(s->store, boxes * sizeof *s->first);
    s->wide = arena_store_room(s->store, boxes * sizeof *s->wide);
    return s->start != NULL && s->length != NULL && s->first != NULL && s->wide != NULL;
}

/* Counts the boxes of each strip, in start[strip + 2]. */
static void count_boxes(strips *s, const division *d, const swept_box *boxes, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        size_t first = 0, last = 0;
        const bool is_wide = !strips_of(d, &boxes[k], &first, &last);
        s->length[k] = is_wide ? 0 : (uint8_t)(last - first + 1);
        s->first[k] = (uint32_t)first;
        if (is_wide) s->wide[s->wide_count++] = (uint32_t)k;
        for (size_t j = 0; j < s->length[k]; ++j) s->start[first + j + 2] += 1;
    }
}

/* Enters the boxes in their order, by which start[strip + 1] becomes the end of its list. */
static void enter_boxes(strips *s, size_t count)
{
    for (size_t j = 0; j < s->count; ++j) s->start[j + 2] += s->start[j + 1];
    for (size_t k = 0; k < count; ++k)
        for (size_t j = 0; j < s->length[k]; ++j)
            s->box[s->start[s->first[k] + j + 1]++] = (uint32_t)k;
}

bool strips_make(strips *s, const swept_box *boxes, size_t count, int axis, double gamma_clear,
                 arena_store *store)
{
    *s = (strips){.store = store};
    if (count < STRIPS_BOXES_LEAST || count > UINT32_MAX / STRIPS_OF_BOX) return true;
    const double reach = padded_upper(gamma_clear > 0 ? gamma_clear : 0, 8);
    const division y = divide(boxes, count, (axis + 1) % 3, reach);
    const division z = divide(boxes, count, (axis + 2) % 3, reach);
    const division d = y.count >= z.count ? y : z;
    s->count = d.count;
    if (s->count == 0) return true;
    if (!allocate(s, count)) return false;
    count_boxes(s, &d, boxes, count);
    size_t entries = 0;
    for (size_t k = 0; k < count; ++k) entries += s->length[k];
    s->box = arena_store_room(store, (entries + 1) * sizeof *s->box);
    if (s->box == NULL) return false;
    enter_boxes(s, count);
    return true;
}

void strips_clear(strips *s)
{
    arena_store_free_room(s->store, s->start);
    arena_store_free_room(s->store, s->box);
    arena_store_free_room(s->store, s->wide);
    arena_store_free_room(s->store, s->length);
    arena_store_free_room(s->store, s->first);
    *s = (strips){.store = s->store};
}

/* --- Visiting --------------------------------------------------------------------------------- */

/* Returns the place of the first number above k in an ascending list. */
static const uint32_t *above(const uint32_t *list, const uint32_t *end, size_t k)
{
    while (list < end) {
        const uint32_t *const middle = list + (end - list) / 2;
        if (*middle > k)
            end = middle;
        else
            list = middle + 1;
    }
    return list;
}

static bool visit_wide(const strips *s, const swept_box *boxes, int axis, size_t k,
                       double gamma_clear, const broad_phase_visitor *visitor)
{
    const uint32_t *const end = s->wide + s->wide_count;
    for (const uint32_t *at = above(s->wide, end, k); at < end; ++at) {
        bool is_beyond = false;
        if (!broad_phase_visit_two(&boxes[k], &boxes[*at], axis, gamma_clear, &is_beyond, visitor))
            return false;
        if (is_beyond) break;
    }
    return true;
}

/* Two boxes that have several strips in common are visited in the first of these. */
static bool visit_strip(const strips *s, const swept_box *boxes, int axis, size_t k, size_t strip,
                        double gamma_clear, const broad_phase_visitor *visitor)
{
    const uint32_t *const end = s->box + s->start[strip + 1];
    for (const uint32_t *at = above(s->box + s->start[strip], end, k); at < end; ++at) {
        bool is_beyond = false;
        if (strip != s->first[k] && s->first[*at] != strip) continue;
        if (!broad_phase_visit_two(&boxes[k], &boxes[*at], axis, gamma_clear, &is_beyond, visitor))
            return false;
        if (is_beyond) break;
    }
    return true;
}

bool strips_visit_box(const strips *s, const swept_box *boxes, size_t count, int axis, size_t k,
                      double gamma_clear, const broad_phase_visitor *visitor)
{
    if (s->count == 0 || s->length[k] == 0)
        return broad_phase_visit_box(boxes, count, axis, k, gamma_clear, visitor);
    if (!visit_wide(s, boxes, axis, k, gamma_clear, visitor)) return false;
    for (size_t j = 0; j < s->length[k]; ++j)
        if (!visit_strip(s, boxes, axis, k, s->first[k] + j, gamma_clear, visitor)) return false;
    return true;
}
