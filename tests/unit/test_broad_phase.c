/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/broad_phase/strips.h"
#include "tests/support/suite.h"

/* The sweep visits each pair of boxes of different groups that are near each other, whichever axis
 * it runs along, once. */

enum { BOXES = 60, MANY = STRIPS_BOXES_LEAST + 60 };

static unsigned char visits[MANY][MANY];

static bool go_on(void *context)
{
    (void)context;
    return true;
}

static bool note(void *context, size_t a, size_t b)
{
    (void)context;
    visits[a < b ? a : b][a < b ? b : a] += 1;
    return true;
}

/* False for a NaN. */
static bool apart(const swept_box *a, const swept_box *b, double gamma_clear)
{
    for (int i = 0; i < 3; ++i)
        if (a->lo[i] - b->hi[i] > gamma_clear || b->lo[i] - a->hi[i] > gamma_clear) return true;
    return false;
}

/* Boxes of sides up to 0.2 in a room of that width along `crowded`, and of 5 else; some without
 * bounds. */
static void draw(swept_box *boxes, size_t count, int crowded, uint64_t groups, uint64_t *state)
{
    const double odd[] = {NAN, INFINITY, -INFINITY, 0};
    for (size_t k = 0; k < count; ++k) {
        boxes[k].owner = k;
        boxes[k].group = random_bits(state) % groups;
        for (int i = 0; i < 3; ++i) {
            const double room = i == crowded ? 0.2 : 5;
            boxes[k].lo[i] = random_between(state, 0, room);
            boxes[k].hi[i] = boxes[k].lo[i] + random_between(state, 0, 0.2);
        }
        if (random_bits(state) % 8 != 0) continue;
        boxes[k].lo[random_bits(state) % 3] = odd[random_bits(state) % 4];
        if (random_bits(state) % 2 == 0)
            boxes[k].hi[random_bits(state) % 3] = odd[random_bits(state) % 2];
    }
}

static void check_visits(const swept_box *given, size_t count, double gamma_clear)
{
    for (size_t a = 0; a < count; ++a)
        for (size_t b = a + 1; b < count; ++b) {
            const bool alike = given[a].group == given[b].group;
            ck_assert_uint_le(visits[a][b], alike ? 0 : 1);
            ck_assert(alike || visits[a][b] == 1 || apart(&given[a], &given[b], gamma_clear));
        }
}

static void sweep(swept_box *boxes, double gamma_clear, const broad_phase_visitor *visitor)
{
    const int axis = broad_phase_sort(boxes, BOXES);
    for (size_t k = 0; k < BOXES; ++k)
        ck_assert(broad_phase_visit_box(boxes, BOXES, axis, k, gamma_clear, visitor));
}

START_TEST(each_two_near_boxes_are_visited_once_along_any_axis)
{
    uint64_t state = suite_seed();
    const broad_phase_visitor visitor = {NULL, note, NULL};
    const uint64_t groups[4] = {1, 2, 7, 1 << 30};
    for (int round = 0; round < suite_times(300); ++round) {
        swept_box boxes[BOXES], given[BOXES];
        const double gamma_clear = round % 2 == 0 ? 1e-6 : 0.1;
        draw(boxes, BOXES, round % 3, groups[round % 4], &state);
        memcpy(given, boxes, sizeof boxes);
        memset(visits, 0, sizeof visits);
        if (round % 4 == 3)
            ck_assert(broad_phase_visit_all(boxes, BOXES, gamma_clear, &visitor));
        else
            sweep(boxes, gamma_clear, &visitor);
        check_visits(given, BOXES, gamma_clear);
    }
}
END_TEST

/* Returns how many boxes lie in several columns. */
static size_t count_divided(const strips *s, size_t count)
{
    size_t divided = 0;
    for (size_t k = 0; k < count; ++k) divided += s->of[k].length[0] * s->of[k].length[1] > 1;
    return divided;
}

/* Rooms of width 5 hold some 30 strips, or 15 by 15. Where the boxes lie on each other along one
 * axis, the sweep and its strips take the other two. */
START_TEST(strips_leave_out_no_near_boxes)
{
    uint64_t state = suite_seed();
    const broad_phase_visitor visitor = {NULL, note, NULL};
    const uint64_t groups[4] = {1, 2, 40, 1 << 30};
    for (int round = 0; round < suite_times(60); ++round) {
        static swept_box boxes[MANY], given[MANY];
        const double gamma_clear = round % 2 == 0 ? 1e-6 : 0.1;
        strips s;
        draw(boxes, MANY, round % 4, groups[round % 4], &state);
        for (size_t k = 0; k < MANY; k += 50) boxes[k].hi[k / 50 % 3] += 3;
        memcpy(given, boxes, sizeof boxes);
        memset(visits, 0, sizeof visits);
        const int axis = broad_phase_sort(boxes, MANY);
        ck_assert(strips_make(&s, boxes, MANY, axis, gamma_clear, NULL));
        ck_assert_uint_ge(s.count[0] * s.count[1], 4);
        ck_assert(s.wide_count > 0 && count_divided(&s, MANY) > MANY / 8);
        for (size_t k = 0; k < MANY; ++k)
            ck_assert(strips_visit_box(&s, boxes, MANY, axis, k, gamma_clear, &visitor));
        strips_clear(&s);
        check_visits(given, MANY, gamma_clear);
    }
}
END_TEST

/* Each box starts where the one before ends along one axis, and all lie upon each other along the
 * others. */
START_TEST(the_sweep_runs_along_the_axis_that_is_not_crowded)
{
    const broad_phase_visitor visitor = {NULL, note, NULL};
    for (int axis = 0; axis < 3; ++axis) {
        swept_box boxes[BOXES];
        for (size_t k = 0; k < BOXES; ++k) {
            const size_t place = (7 * k) % BOXES; /* 7 and BOXES have no common factor */
            boxes[k] = (swept_box){{0, 0, 0}, {1, 1, 1}, k, k, 0};
            boxes[k].lo[axis] = 2.0 * (double)place;
            boxes[k].hi[axis] = boxes[k].lo[axis] + 1;
        }
        memset(visits, 0, sizeof visits);
        sweep(boxes, 0.5, &visitor);
        for (size_t k = 1; k < BOXES; ++k) ck_assert(boxes[k - 1].lo[axis] < boxes[k].lo[axis]);
    }
}
END_TEST

/* Boxes whose numbers have an even sum are not accepted, nor are boxes of one group. */
static bool accept(void *context, size_t a, size_t b)
{
    (void)context;
    return (a + b) % 2 != 0;
}

static double greatest_distance(const swept_box *a, const swept_box *b)
{
    double square = 0;
    for (int i = 0; i < 3; ++i) {
        const double up = b->hi[i] - a->lo[i], down = a->hi[i] - b->lo[i];
        square += isnan(up) || isnan(down) ? NAN : up > down ? up * up : down * down;
    }
    return sqrt(square);
}

START_TEST(the_least_distance_bounds_that_of_some_boxes)
{
    uint64_t state = suite_seed();
    const broad_phase_visitor visitor = {go_on, accept, NULL};
    const uint64_t groups[4] = {1, 2, 7, 1 << 30};
    for (int round = 0; round < suite_times(300); ++round) {
        swept_box boxes[BOXES];
        draw(boxes, BOXES, round % 3, groups[round % 4], &state);
        const int axis = broad_phase_sort(boxes, BOXES);
        double expected = INFINITY;
        for (size_t a = 0; a < BOXES; ++a)
            for (size_t b = a + 1; b < BOXES; ++b) {
                const double most = greatest_distance(&boxes[a], &boxes[b]);
                if (boxes[a].group != boxes[b].group && most < expected &&
                    accept(NULL, boxes[a].owner, boxes[b].owner))
                    expected = most;
            }
        const double least = broad_phase_least_distance(boxes, BOXES, axis, &visitor);
        ck_assert(least == expected || (expected <= least && least <= expected * (1 + 1e-14)));
        ck_assert(groups[round % 4] > 1 || least == INFINITY);
    }
}
END_TEST

SUITE_MAIN("broad phase", each_two_near_boxes_are_visited_once_along_any_axis,
           strips_leave_out_no_near_boxes, the_sweep_runs_along_the_axis_that_is_not_crowded,
           the_least_distance_bounds_that_of_some_boxes)
