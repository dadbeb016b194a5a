/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/polygon.h"

#include <math.h>
#include <stdlib.h>

/* Twice the area of a triangle; positive: a, b, c turn left. */
static double turn(point2 a, point2 b, point2 c)
{
    return (b.x[0] - a.x[0]) * (c.x[1] - a.x[1]) - (b.x[1] - a.x[1]) * (c.x[0] - a.x[0]);
}

/* --- Hulls ------------------------------------------------------------------------------------ */

static int compare(const void *x, const void *y)
{
    const point2 *a = x, *b = y;
    for (int i = 0; i < 2; ++i)
        if (a->x[i] != b->x[i]) return a->x[i] < b->x[i] ? -1 : 1;
    return 0;
}

/* Makes room for one corner more. */
static void make_room(polygon *p)
{
    if (p->count == POLYGON_MAX) polygon_reduce(p, POLYGON_MAX - 1);
}

/* Adds a point to a chain that turns left from `first` on. */
static void add_to_chain(polygon *p, size_t first, point2 x)
{
    while (p->count >= first + 2 && turn(p->at[p->count - 2], p->at[p->count - 1], x) <= 0)
        p->count -= 1;
    make_room(p);
    p->at[p->count++] = x;
}

/* Andrew's monotone chains: the lower one, then the upper one back. */
polygon polygon_hull(point2 *points, size_t n)
{
    polygon p = {.count = 0};
    if (n == 0) return p;
    qsort(points, n, sizeof *points, compare);
    for (size_t i = 0; i < n; ++i)
        if (i == 0 || compare(&points[i], &points[i - 1]) != 0) add_to_chain(&p, 0, points[i]);
    const size_t lower = p.count;
    if (lower == 1) return p;
    for (size_t i = n - 1; i-- > 0;)
        if (compare(&points[i], &points[i + 1]) != 0) add_to_chain(&p, lower - 1, points[i]);
    p.count -= 1; /* the first point again */
    return p;
}

static void remove_corner(polygon *p, size_t i)
{
    p->count -= 1;
    for (; i < p->count; ++i) p->at[i] = p->at[i + 1];
}

static double distance(point2 a, point2 b) { return hypot(a.x[0] - b.x[0], a.x[1] - b.x[1]); }

/* Returns how far b is from the segment between a and c. */
static double off_segment(point2 a, point2 b, point2 c)
{
    const double dx = c.x[0] - a.x[0], dy = c.x[1] - a.x[1], square = dx * dx + dy * dy;
    const double way = (b.x[0] - a.x[0]) * dx + (b.x[1] - a.x[1]) * dy;
    const double part = square > 0 ? fmin(fmax(way / square, 0), 1) : 0;
    return distance(b, (point2){{a.x[0] + part * dx, a.x[1] + part * dy}});
}

void polygon_simplify(polygon *p, double most)
{
    for (size_t i = 0; i < p->count && p->count > 1;)
        if (distance(p->at[i], p->at[(i + 1) % p->count]) <= most)
            remove_corner(p, i);
        else
            ++i;
    for (size_t i = 0; i < p->count && p->count > 2;) {
        const point2 before = p->at[(i + p->count - 1) % p->count];
        if (off_segment(before, p->at[i], p->at[(i + 1) % p->count]) <= most)
            remove_corner(p, i);
        else
            ++i;
    }
}

void polygon_reduce(polygon *p, size_t most)
{
    while (p->count > most && p->count > 0) {
        size_t least = 0;
        double area = INFINITY;
        for (size_t i = 0; i < p->count; ++i) {
            const point2 before = p->at[(i + p->count - 1) % p->count];
            const double lost = fabs(turn(before, p->at[i], p->at[(i + 1) % p->count]));
            if (lost < area) area = lost, least = i;
        }
        remove_corner(p, least);
    }
}

polygon polygon_grow(const polygon *p, double by)
{
    point2 corner[4 * POLYGON_MAX];
    for (size_t i = 0; i < 4 * p->count; ++i) {
        const point2 x = p->at[i / 4];
        corner[i] = (point2){{x.x[0] + (i & 1 ? by : -by), x.x[1] + (i & 2 ? by : -by)}};
    }
    return polygon_hull(corner, 4 * p->count);
}

/* --- Intersection ----------------------------------------------------------------------------- */

/* Returns the part of a polygon to the left of the line from a to b (Sutherland and Hodgman). */
static polygon clip(const polygon *p, point2 a, point2 b)
{
    polygon left = {.count = 0};
    for (size_t i = 0; i < p->count; ++i) {
        const point2 x = p->at[i], y = p->at[(i + 1) % p->count];
        const double at_x = turn(a, b, x), at_y = turn(a, b, y);
        make_room(&left);
        if (at_x >= 0) left.at[left.count++] = x;
        if ((at_x > 0 && at_y < 0) || (at_x < 0 && at_y > 0)) {
            const double s = at_x / (at_x - at_y);
            make_room(&left);
            left.at[left.count++] =
                (point2){{x.x[0] + s * (y.x[0] - x.x[0]), x.x[1] + s * (y.x[1] - x.x[1])}};
        }
    }
    return left;
}

polygon polygon_intersect(const polygon *a, const polygon *b)
{
    polygon p = *a;
    for (size_t i = 0; i < b->count && p.count > 0; ++i)
        p = clip(&p, b->at[i], b->at[(i + 1) % b->count]);
    return p;
}
