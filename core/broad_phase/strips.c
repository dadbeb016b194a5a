/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/broad_phase/strips.h"

#include <math.h>

#include "core/base/rounding.h"

/* Fewer strips than this would leave out too few boxes; more take memory for nothing. */
enum { STRIPS_LEAST = 4, STRIPS_MOST = 1 << 15 };

/* --- Which strips a box lies in --------------------------------------------------------------- */

/* Another axis and its division. */
typedef struct division {
    int axis;
    double from, per_length; /* where the first strip starts; strips per length */
    double reach;            /* added below each box, >= the gap of boxes that are near; length */
    size_t count;            /* 1: it is not divided */
} division;

/* Returns the strip of a coordinate that is no NaN; those beyond the ends count to the first or
 * last. It never falls when x rises, since no rounding reverses an order. */
static size_t strip_at(const division *d, double x)
{
    const double at = (x - d->from) * d->per_length;
    if (!(at > 0)) return 0;
    return at < (double)d->count ? (size_t)at : d->count - 1;
}

/* Finds the strips of a box along one axis. False: it is wide.
 *
 * Lemma. If two boxes that are not wide are near each other, they have a strip in common along
 * either axis, and so a column. Near means that padded_lower(fl(lo - hi), 2) <= gamma_clear for the
 * start of each and the end of the other, so lo - hi <= reach = padded_upper(gamma_clear, 8): a pad
 * of two units and three roundings are less than a pad of 8. Hence lo - reach <= hi exactly, and
 * fl(lo - reach) <= hi: the first strip of each is at most the last of the other. */
PAD_COVERS(8, 2 + 3);
static bool strips_along(const division *d, const swept_box *box, size_t *first, size_t *last)
{
    *first = *last = 0;
    if (d->count <= 1) return true;
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
    division d = {.axis = axis, .from = first - reach, .reach = reach, .count = 1};
    if (!(wanted >= STRIPS_LEAST && wanted < INFINITY)) return d;
    d.count = wanted < STRIPS_MOST ? (size_t)wanted : STRIPS_MOST;
    d.per_length = (double)d.count / (last - first);
    return d;
}

/* --- Making ----------------------------------------------------------------------------------- */

static bool allocate(strips *s, size_t boxes)
{
    const size_t columns = s->count[0] * s->count[1];
    s->start = arena_store_zeroed(s->store, (columns + 2) * sizeof *s->start);
    s->of = arena_store_room(s->store, boxes * sizeof *s->of);
    s->wide = arena_store_room(s->store, boxes * sizeof *s->wide);
    return s->start != NULL && s->of != NULL && s->wide != NULL;
}

static strips_of_box strips_of(const division d[2], const swept_box *box)
{
    strips_of_box of = {{0, 0}, {0, 0}};
    size_t first[2], last[2];
    for (int j = 0; j < 2; ++j)
        if (!strips_along(&d[j], box, &first[j], &last[j])) return of;
    for (int j = 0; j < 2; ++j) {
        of.first[j] = (uint16_t)first[j];
        of.length[j] = (uint8_t)(last[j] - first[j] + 1);
    }
    return of;
}

static size_t columns_of(const strips_of_box *of) { return (size_t)of->length[0] * of->length[1]; }

/* Finds column k of a box, from 0: its strip along either axis. Returns its number of all. */
static size_t column_at(const strips *s, const strips_of_box *of, size_t k, size_t strip[2])
{
    strip[0] = of->first[0] + k / of->length[1];
    strip[1] = of->first[1] + k % of->length[1];
    return strip[0] * s->count[1] + strip[1];
}

/* Counts the boxes of each column, in start[column + 2], and returns how many these are in all. */
static size_t count_boxes(strips *s, const division d[2], const swept_box *boxes, size_t count)
{
    size_t entries = 0, strip[2];
    for (size_t k = 0; k < count; ++k) {
        const strips_of_box *of = &s->of[k];
        s->of[k] = strips_of(d, &boxes[k]);
        const size_t columns = columns_of(of);
        if (columns == 0) s->wide[s->wide_count++] = (uint32_t)k;
        for (size_t j = 0; j < columns; ++j) s->start[column_at(s, of, j, strip) + 2] += 1;
        entries += columns;
    }
    return entries;
}

/* Enters the boxes in their order, by which start[column + 1] becomes the end of its list. */
static void enter_boxes(strips *s, size_t count)
{
    const size_t columns = s->count[0] * s->count[1];
    size_t strip[2];
    for (size_t j = 0; j < columns; ++j) s->start[j + 2] += s->start[j + 1];
    for (size_t k = 0; k < count; ++k)
        for (size_t j = 0; j < columns_of(&s->of[k]); ++j)
            s->box[s->start[column_at(s, &s->of[k], j, strip) + 1]++] = (uint32_t)k;
}

/* Makes strips wider where there are more columns than boxes. */
static void limit_columns(division d[2], size_t count)
{
    while (d[0].count * d[1].count > count) {
        division *most = d[0].count < d[1].count ? &d[1] : &d[0];
        most->count /= 2;
        most->per_length *= 0.5;
    }
}

bool strips_make(strips *s, const swept_box *boxes, size_t count, int axis, double gamma_clear,
                 arena_store *store)
{
    *s = (strips){.store = store};
    if (count < STRIPS_BOXES_LEAST || count > UINT32_MAX / (STRIPS_OF_BOX * STRIPS_OF_BOX))
        return true;
    const double reach = padded_upper(gamma_clear > 0 ? gamma_clear : 0, 8);
    division d[2] = {divide(boxes, count, (axis + 1) % 3, reach),
                     divide(boxes, count, (axis + 2) % 3, reach)};
    limit_columns(d, count);
    if (d[0].count * d[1].count <= 1) return true;
    for (int j = 0; j < 2; ++j) s->count[j] = d[j].count;
    if (!allocate(s, count)) return false;
    const size_t entries = count_boxes(s, d, boxes, count);
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
    arena_store_free_room(s->store, s->of);
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

/* Visits the pairs of box k in its column j. Two boxes that have several columns in common are
 * visited in that of their first common strip along either axis. */
static bool visit_column(const strips *s, const swept_box *boxes, int axis, size_t k, size_t j,
                         double gamma_clear, const broad_phase_visitor *visitor)
{
    const strips_of_box *own = &s->of[k];
    size_t strip[2];
    const size_t column = column_at(s, own, j, strip);
    const uint32_t *const end = s->box + s->start[column + 1];
    for (const uint32_t *at = above(s->box + s->start[column], end, k); at < end; ++at) {
        const strips_of_box *other = &s->of[*at];
        bool is_beyond = false;
        if (strip[0] != own->first[0] && strip[0] != other->first[0]) continue;
        if (strip[1] != own->first[1] && strip[1] != other->first[1]) continue;
        if (!broad_phase_visit_two(&boxes[k], &boxes[*at], axis, gamma_clear, &is_beyond, visitor))
            return false;
        if (is_beyond) break;
    }
    return true;
}

bool strips_visit_box(const strips *s, const swept_box *boxes, size_t count, int axis, size_t k,
                      double gamma_clear, const broad_phase_visitor *visitor)
{
    if (s->count[0] == 0 || columns_of(&s->of[k]) == 0)
        return broad_phase_visit_box(boxes, count, axis, k, gamma_clear, visitor);
    if (!visit_wide(s, boxes, axis, k, gamma_clear, visitor)) return false;
    for (size_t j = 0; j < columns_of(&s->of[k]); ++j)
        if (!visit_column(s, boxes, axis, k, j, gamma_clear, visitor)) return false;
    return true;
}
