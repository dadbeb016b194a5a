/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/clearance_helpers.h"

/* Witnesses of minimum distances: polished where they are, and let fall in time. */

/* Both searches find the least distance by one witness, so that hardly a pair is left. */
static void find_at_once(const char *a, const char *b, double distance, uint64_t pairs)
{
    imp_registry *registry = query_registry();
    const imp_clearance r = measure_pair(registry, a, b, 1e-3, 0);
    ck_assert_msg(r.upper <= distance * (1 + 1e-4), "%s, %s: upper %.17g of %.17g", a, b, r.upper,
                  distance);
    ck_assert_double_ge(r.upper, distance * (1 - 1e-9));
    ck_assert_double_le(r.lower, distance * (1 + 1e-9));
    ck_assert_msg(r.stats.pairs <= pairs, "%s, %s: %llu pairs", a, b,
                  (unsigned long long)r.stats.pairs);
    imp_registry_free(registry);
}

/* Its lowest point is where the ball's parameters end. */
START_TEST(points_near_a_floor_are_polished)
{
    find_at_once("sphere center=-1,0,1.000001 ! rotate axis=0,1,0 rate=2 center=-1,0,1.000001 ! "
                 "translate velocity=2,0,0",
                 "plane origin=-3,-3,0 edge_u=6,0,0 edge_v=0,6,0", 1e-6, 20);
}
END_TEST

START_TEST(a_spinning_ring_is_nearest_at_its_rim)
{
    find_at_once("torus major_radius=1 minor_radius=0.25 ! rotate axis=0,0,1 rate=100",
                 "sphere radius=0.5 center=1.85,0,0", 0.1, 60);
}
END_TEST

/* A corner passes the ball 1.2071 from the axis; which of 1272 times is of no consequence. */
START_TEST(a_corner_that_passes_is_followed_to_its_nearest_moment)
{
    find_at_once("box size=1,1,0.2 ! rotate axis=0,0,1 rate=1000",
                 "sphere radius=0.5 center=1.3071067811865475,0,0", 0.1, 20);
}
END_TEST

START_TEST(a_ball_that_passes_is_followed_to_its_nearest_moment)
{
    find_at_once(still, passing, 0.5, 20);
}
END_TEST

/* From the middle of either surface v descends to the pole, along a u that is opposite. */
START_TEST(a_pole_is_crossed)
{
    const char *const points[] = {"point position=0.1,0,2", "point position=0.1,0,-2"};
    for (int k = 0; k < 2; ++k)
        find_at_once("ellipsoid radii=1,1.2,1.1", points[k], 0.902761527834539, 4);
}
END_TEST

SUITE_MAIN("time_descent", points_near_a_floor_are_polished, a_spinning_ring_is_nearest_at_its_rim,
           a_corner_that_passes_is_followed_to_its_nearest_moment,
           a_ball_that_passes_is_followed_to_its_nearest_moment, a_pole_is_crossed)
