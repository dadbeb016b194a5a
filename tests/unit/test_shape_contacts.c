/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/shape_points.h"

/* Earliest contacts of our types whose times are known. */

static void expect_contact(const char *a, const char *b, double time, double early)
{
    const question q = {.a = a, .b = b};
    ask_contact(&q, time, early);
}

START_TEST(a_falling_vertex_meets_a_face)
{
    expect_contact("triangle points=[[-1,-1,0],[2,-1,0],[-1,2,0]]",
                   "point position=0.1,0.2,1.5 velocity=0,0,-2", 0.75, 1e-6);
    expect_contact(
        "triangle points=[[-1,-1,0],[2,-1,0],[-1,2,0]] velocities=[[0,0,1],[0,0,1],[0,0,1]]",
        "point position=0.1,0.2,1.5 velocity=0,0,-2", 0.5, 1e-6);
}
END_TEST

START_TEST(an_edge_meets_an_edge)
{
    expect_contact("segment points=[[-1,0,0],[1,0,0]]",
                   "segment points=[[0.3,-1,1],[0.3,1,2]] velocities=[[0,0,-3],[0,0,-3]]", 0.5,
                   1e-6);
    const question past = {.a = "segment points=[[-1,0,0],[1,0,0]]",
                           .b = "segment points=[[1.1,-1,1],[1.1,1,1]] "
                                "velocities=[[0,0,-3],[0,0,-3]]"};
    ask_clear(&past);
}
END_TEST

START_TEST(a_bullet_does_not_pass_through_a_plate)
{
    expect_contact("plane origin=-1,-1,0 edge_u=2,0,0 edge_v=0,2,0",
                   "point position=0.123,0.2,500000 velocity=0,0,-1000000", 0.5, 1e-11);
}
END_TEST

/* Support height of the ellipsoid turned by 2 t: sqrt(a^2 sin^2 + c^2 cos^2). It reaches 1.2 where
 * sin^2 = 0.44 / 3. */
START_TEST(a_turning_ellipsoid_reaches_a_plane)
{
    expect_contact("ellipsoid radii=2,1,1 ! rotate axis=0,1,0 rate=2",
                   "plane origin=-5,-5,-1.2 edge_u=10,0,0 edge_v=0,10,0", asin(sqrt(0.44 / 3)) / 2,
                   1e-6);
}
END_TEST

/* The crest of the wave reaches the point where sin(2 pi (0 - t)) = 0.5 first: t = 7/12. */
START_TEST(a_wave_rises_to_a_point)
{
    expect_contact("ripple amplitude=0.1", "point position=0,0,0.05", 7. / 12, 1e-4);
}
END_TEST

START_TEST(the_apex_of_a_cone_pierces)
{
    expect_contact("cone radius=1 height=2 ! translate velocity=0,0,3",
                   "plane origin=-2.3,-2.1,3.5 edge_u=5,0,0 edge_v=0,5,0", 0.5, 1e-6);
}
END_TEST

START_TEST(triangles_of_a_paraboloid_and_of_a_sphere_are_met_where_these_are)
{
    expect_contact("bezier-triangle degree=2 points=[[-1,-1,2],[0,-0.5,-1],[-0.5,1,-3],[1,0,1],"
                   "[0.5,1.5,0],[0,3,9]]",
                   "point position=0.1,0.2,1.05 velocity=0,0,-2", 0.5, 1e-6);
    expect_contact(octant_text(true), "point position=0.48,0.6,1.64 velocity=0,0,-2", 0.5, 1e-6);
}
END_TEST

/* The corner u = 0 of both, the degenerate one, meets a corner: they move along the line
 * between. */
START_TEST(collapsed_corners_meet)
{
    expect_contact(
        "bezier-triangle degree=3 points=[[0,0,0],[1,0,-1],[0,1,-1],[2,0,-2],[1,1,-2],[0,2,-2],"
        "[3,0,-2],[2,1,-2],[1,2,-2],[0,3,-2]]",
        "bezier-triangle points=[[0,0,2],[-1,0,2.5],[0,-1,2.5],[-2,0,3],[-1,-1,3],[0,-2,3]] ! "
        "translate velocity=0,0,-4",
        0.5, 1e-6);
}
END_TEST

/* Exponents 2 make an octahedron, whose face x + y + z = 1 holds (1/3, 1/3, 1/3). */
START_TEST(the_bevel_of_a_superellipsoid_is_met_where_it_is)
{
    expect_contact("superellipsoid exponents=2,2", "point position=1,1,1 velocity=-1,-1,-1", 2. / 3,
                   1e-6);
}
END_TEST

SUITE_MAIN("shape_contacts", a_falling_vertex_meets_a_face, an_edge_meets_an_edge,
           a_bullet_does_not_pass_through_a_plate, a_turning_ellipsoid_reaches_a_plane,
           a_wave_rises_to_a_point, the_apex_of_a_cone_pierces,
           the_bevel_of_a_superellipsoid_is_met_where_it_is,
           triangles_of_a_paraboloid_and_of_a_sphere_are_met_where_these_are,
           collapsed_corners_meet)
