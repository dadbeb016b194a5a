/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/strategy.h"
#include "core/bounds/tuning.h"
#include "tests/support/suite.h"

/* The rows of strategy.h's table, on nodes that have nothing but what a plan looks at. */

/* A patch of extent 1 along u and v, in the plane z = 0, at the times [0, 1]. */
static node flat_patch(void)
{
    node n = {.region = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1}),
              .extent = {1, 1, 0},
              .bounded = true};
    n.f.bu[0] = n.f.bv[1] = 0.5;
    return n;
}

static node curved_patch(double bend)
{
    node n = flat_patch();
    n.f.quu[2] = n.f.qvv[2] = bend;
    return n;
}

static node straight_edge(void)
{
    node n = flat_patch();
    n.f.bv[1] = 0;
    n.extent[PARAMETER_V] = 0;
    return n;
}

static const net bilinear = {.degree = {1, 1}}, bicubic = {.degree = {3, 3}};

START_TEST(hulls_are_tried_where_a_node_gains_by_its_net)
{
    node a = curved_patch(0.1), b = flat_patch();
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_NONE);
    a.net = &bicubic;
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_OF_ONE);
    ck_assert_int_eq(strategy_hulls_of(&b, &a), HULLS_OF_ONE);
    b.net = &bilinear;
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_OF_BOTH);
    ck_assert(strategy_has_both_hulls(&b, &a));
}
END_TEST

START_TEST(hulls_of_straight_nodes_without_remainders_are_of_no_use)
{
    node a = flat_patch(), b = flat_patch();
    a.net = b.net = &bilinear;
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_NONE);
    a.e[0] = 1e-3;
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_FLAT);
    b.net = &net_none;
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_OF_ONE);
    a.e[0] = 1e-12; /* rounding */
    ck_assert_int_eq(strategy_hulls_of(&a, &b), HULLS_NONE);
}
END_TEST

START_TEST(quadratics_follow_hulls_where_they_are_closer)
{
    node a = curved_patch(0.5), b = curved_patch(0.5);
    a.e[0] = 1e-3;
    ck_assert_int_eq(strategy_after(HULLS_OF_BOTH, &a, &b, true), AFTER_HULLS_ONE_CUT);
    a.e[0] = 10;
    ck_assert_int_eq(strategy_after(HULLS_OF_BOTH, &a, &b, true), AFTER_HULLS_NOTHING);
    ck_assert_int_eq(strategy_after(HULLS_OF_BOTH, &a, &b, false), AFTER_HULLS_ONE_CUT);
    ck_assert_int_eq(strategy_after(HULLS_OF_ONE, &a, &b, true), AFTER_HULLS_ONE_CUT);
    a = b = flat_patch();
    ck_assert_int_eq(strategy_after(HULLS_OF_ONE, &a, &b, true), AFTER_HULLS_QUADRATICS);
}
END_TEST

START_TEST(only_contacts_of_curves_are_cut_along_axes_without_a_search)
{
    node edge = straight_edge(), patch = flat_patch(), arc = straight_edge();
    arc.e[0] = 1;
    const quadratic_plan edges = strategy_of_quadratics(&edge, &edge, GOAL_CONTACT);
    ck_assert(edges.is_thin && edges.rounds_across == TUNING_THIN_ROUNDS);
    const quadratic_plan arcs = strategy_of_quadratics(&edge, &arc, GOAL_CONTACT);
    ck_assert(!arcs.is_thin && arcs.rounds_across == TUNING_CURVE_ROUNDS);
    ck_assert_int_eq(strategy_of_quadratics(&edge, &patch, GOAL_CONTACT).rounds_across, 0);
    ck_assert_int_eq(strategy_of_quadratics(&edge, &edge, GOAL_DISTANCE).rounds_across, 0);
}
END_TEST

START_TEST(flat_nodes_are_searched_more_often_and_at_the_end)
{
    const node flat = flat_patch(), curved = curved_patch(0.5);
    const search_plan flats = strategy_of_searches(&flat, &flat, GOAL_CONTACT);
    ck_assert(flats.cuts_at_end && flats.rounds > TUNING_WINDOW_ROUNDS);
    ck_assert(!strategy_of_searches(&flat, &flat, GOAL_DISTANCE).cuts_at_end);
    const search_plan others = strategy_of_searches(&flat, &curved, GOAL_CONTACT);
    ck_assert(!others.cuts_at_end && others.shrinks < flats.shrinks);
}
END_TEST

START_TEST(a_turning_axis_that_never_pays_is_tried_now_and_then)
{
    const w_range whole = {-1, 1}, late = {0.5, 1};
    trial_rate rate = {0};
    int tried = 0;
    for (int k = 0; k < 100; ++k) {
        ck_assert(strategy_takes_turning(&whole, &rate));
        strategy_note_turning(&whole, &whole, true, &rate); /* does not count */
        if (!strategy_takes_turning(&late, &rate)) continue;
        strategy_note_turning(&late, &late, true, &rate);
        ++tried;
    }
    ck_assert_int_ge(tried, 100 / (TUNING_FIELD_WAIT + 1));
    ck_assert_int_le(tried, 100 / (TUNING_FIELD_WAIT + 1) + 1);
    ck_assert(strategy_takes_turning(&late, NULL));
}
END_TEST

START_TEST(nodes_parted_from_the_start_of_their_times_are_asked_for_no_distance)
{
    const node a = curved_patch(0.5), b = curved_patch(0.5);
    slide_signs signs = {.start = 0, .is_parted = false};
    ck_assert(strategy_takes_distances(&a, &b, &signs, GOAL_CONTACT));
    signs.start = 0.25;
    ck_assert(!strategy_takes_distances(&a, &b, &signs, GOAL_CONTACT));
    ck_assert(strategy_takes_distances(&a, &b, &signs, GOAL_DISTANCE));
    signs.slides = true;
    ck_assert(strategy_takes_distances(&a, &b, &signs, GOAL_CONTACT));
    signs.slides = false, signs.is_parted = true;
    ck_assert(!strategy_takes_distances(&a, &b, &signs, GOAL_CONTACT));
    ck_assert(!strategy_takes_distances(&a, &b, &signs, GOAL_DISTANCE));
}
END_TEST

START_TEST(what_moves_along_a_face_is_asked_for_its_distance_from_that)
{
    node a = curved_patch(0.5), face = flat_patch();
    a.f.bt[0] = 1;
    ck_assert(strategy_slides_on_face(&a, &face));
    ck_assert(strategy_takes_distances(&a, &face, &(slide_signs){.is_parted = true}, GOAL_CONTACT));
    a.f.bt[2] = 1e-3;
    ck_assert(!strategy_slides_on_face(&a, &face));
    ck_assert(!strategy_slides_on_face(&face, &a)); /* is not flat */
}
END_TEST

START_TEST(common_maps_are_paid_for_where_nodes_are_large_or_tangent)
{
    node a = curved_patch(0.5), b = curved_patch(0.5);
    ck_assert(strategy_is_tangent(&a, &b) && strategy_distance_pays(&a, &b, 1));
    memcpy(b.f.bu, (double[3]){0, 0.5, 0}, sizeof b.f.bu); /* b lies in the plane x = 0 */
    memcpy(b.f.bv, (double[3]){0, 0, 0.5}, sizeof b.f.bv);
    ck_assert(!strategy_is_tangent(&a, &b) && !strategy_distance_pays(&a, &b, 1));
    ck_assert(strategy_distance_pays(&a, &b, 0));
    b.e[0] = 10;
    ck_assert(strategy_distance_pays(&a, &b, 1));
}
END_TEST

SUITE_MAIN("strategy", hulls_are_tried_where_a_node_gains_by_its_net,
           hulls_of_straight_nodes_without_remainders_are_of_no_use,
           quadratics_follow_hulls_where_they_are_closer,
           only_contacts_of_curves_are_cut_along_axes_without_a_search,
           flat_nodes_are_searched_more_often_and_at_the_end,
           a_turning_axis_that_never_pays_is_tried_now_and_then,
           nodes_parted_from_the_start_of_their_times_are_asked_for_no_distance,
           what_moves_along_a_face_is_asked_for_its_distance_from_that,
           common_maps_are_paid_for_where_nodes_are_large_or_tangent)
