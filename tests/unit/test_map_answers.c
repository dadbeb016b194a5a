/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

/* Earliest contacts of what is moved and deformed, at times known in closed form. */

START_TEST(a_sphere_that_grows_meets_its_neighbour)
{
    const question q = {.a = "sphere radius=1 ! scale factors=[[1],[1]]",
                        .b = "sphere radius=1 center=2,1.5,0"}; /* at 2.5 */
    ask_contact(&q, 0.5, 2e-6);
}
END_TEST

START_TEST(a_hollow_sphere_that_collapses_meets_what_is_inside)
{
    const question q = {.a = "sphere radius=2 ! scale factors=[[1],[-1]]",
                        .b = "sphere radius=0.5 center=0.3,0,0.4"};
    ask_contact(&q, 0.5, 1e-6); /* 2 (1 - t) = 0.5 + 0.5 */
}
END_TEST

START_TEST(a_ball_on_a_screw_meets_the_ceiling)
{
    const question q = {
        .a = "sphere radius=0.125 center=1,0,0 ! screw pitch=1 rate=6.283185307179586",
        .b = "plane origin=-3,-3,0.625 edge_u=6,0,0 edge_v=0,6,0"};
    ask_contact(&q, 0.5, 2e-6);
}
END_TEST

/* A rim's radius is 1 + t at the end of the range, a kink, and less everywhere else. */
START_TEST(a_cylinder_widens_until_its_kink_touches_the_wall)
{
    const question q = {.a = "cylinder radius=1 height=4"
                             " ! taper range=[-2,0.5] start=1 end=[1,1]"
                             " ! taper range=[0.5,2] start=1 end=0.25",
                        .b = "plane origin=1.5,-3,-3 edge_u=0,6,0 edge_v=0,0,6"};
    ask_contact(&q, 0.5, 2e-6);
}
END_TEST

/* The end of a rod of length 2 with the curvature c rises to (1 - cos 2c) / c; at c = pi/4 that is
 * 4 / pi. */
START_TEST(a_rod_bends_up_to_the_ceiling)
{
    const question q = {.a = "segment points=[[0,0,0],[0,2,0]]"
                             " ! bend range=0,2 curvature=[0,1.5707963267948966]",
                        .b = "plane origin=-1,-1,1.2732395447351628 edge_u=2,0,0 edge_v=0,4,0"};
    ask_contact(&q, 0.5, 2e-6);
}
END_TEST

/* At x = 0 the sheet rises as sin(2 t) / 4. */
START_TEST(a_wave_rises_to_a_point)
{
    const question q = {.a = "plane origin=-0.01,-1,0 edge_u=0.02,0,0 edge_v=0,2,0"
                             " ! wave amplitude=0,0,0.25 wave_vector=0,1e-9,0 speed=-2e9",
                        .b = "point position=0,0,0.125"};
    ask_contact(&q, 0.2617993877991494, 1e-5); /* pi / 12 */
}
END_TEST

/* A plank in the plane x = 0 twists about z: its edge, at distance 1 and height 1, turns by t. */
START_TEST(a_plank_twists_into_a_peg)
{
    const question q = {.a = "segment points=[[0,1,1],[0,0.5,1]] ! twist rate=[0,1]",
                        .b = "point position=-0.479425538604203,0.8775825618903728,1"};
    ask_contact(&q, 0.5, 3e-6);
}
END_TEST

START_TEST(keys_of_free_fall_meet_the_ground)
{
    const question q = {.a = "sphere radius=0.75 ! keyframes times=[0,0.5,1,1.5,2]"
                             " positions=[[0,0,6],[1,0,4.75],[2,0,1],[3,0,-5.25],[4,0,-14]]",
                        .b = "plane origin=-9,-9,0.25 edge_u=18,0,0 edge_v=0,18,0",
                        .t_end = 2};
    ask_contact(&q, 1, 1e-6); /* 6 - 5 t^2 = 1 */
}
END_TEST

START_TEST(keys_turn_a_paddle_into_a_peg)
{
    const question q = {.a = "segment points=[[0.5,0,0],[2,0,0]] ! keyframes times=[0,1]"
                             " rotations=[[1,0,0,0],[0.7071067811865476,0,0,0.7071067811865476]]",
                        .b = "point position=1.0606601717798214,1.0606601717798214,0"};
    ask_contact(&q, 0.5, 2e-6); /* by symmetry half of the quarter turn */
}
END_TEST

START_TEST(a_lattice_that_swells_carries_its_content_along)
{
    const question q = {
        .a = "sphere radius=0.5 ! ffd points=[[-1,-1,-1],[-1,-1,1],[-1,1,-1],[-1,1,1],"
             "[1,-1,-1],[1,-1,1],[1,1,-1],[1,1,1]] velocities=[[-1,-1,-1],[-1,-1,1],"
             "[-1,1,-1],[-1,1,1],[1,-1,-1],[1,-1,1],[1,1,-1],[1,1,1]]",
        .b = "sphere radius=1 center=0,0,1.75"};
    ask_contact(&q, 0.5, 3e-6); /* radius (1 + t) / 2 */
}
END_TEST

/* Five motions and deformations, and what undoes them: the answer is that of none. */
START_TEST(ten_maps_are_composed_as_one)
{
    const question q = {
        .a = "torus major_radius=1 minor_radius=0.25"
             " ! translate velocity=1,2,3 ! rotate axis=1,2,2 rate=2 ! scale factor=2,2,2"
             " ! screw axis=0,1,0 pitch=2 rate=1 ! twist axis=0,0,1 rate=0.5"
             " ! twist axis=0,0,1 rate=-0.5 ! screw axis=0,1,0 pitch=2 rate=-1"
             " ! scale factor=0.5 ! rotate axis=1,2,2 rate=-2 ! translate velocity=-1,-2,-3",
        .b = "sphere radius=0.25 center=3,0,0 ! translate velocity=-3,0,0",
        .max_pairs = 20000};
    ask_contact(&q, 0.5, 1e-6);
}
END_TEST

static void print_track(FILE *out, int keys)
{
    fprintf(out, "torus ! keyframes times=[");
    for (int i = 0; i < keys; ++i) fprintf(out, "%s%.17g", i ? "," : "", i / (keys - 1.));
    fprintf(out, "] positions=[");
    for (int i = 0; i < keys; ++i) {
        const double t = i / (keys - 1.);
        fprintf(out, "%s[%.17g,%.17g,%.17g]", i ? "," : "", 3 * cos(20 * t), 3 * sin(20 * t),
                0.3 * sin(97 * t));
    }
    fprintf(out, "] rotations=[");
    for (int i = 0; i < keys; ++i) {
        const double half = 15 * i / (keys - 1.);
        fprintf(out, "%s[%.17g,0,%.17g,%.17g]", i ? "," : "", cos(half), 0.6 * sin(half),
                0.8 * sin(half));
    }
    fprintf(out, "]");
}

START_TEST(a_track_of_a_thousand_keys_is_cheap)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    print_track(out, 1000);
    fclose(out);
    const question q = {.a = text,
                        .b = "sphere radius=0.5 center=0,-1.9,2 ! translate velocity=0,0,-2",
                        .max_pairs = 10000};
    const imp_result r = ask(&q);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    free(text);
}
END_TEST

SUITE_MAIN("map answers", a_sphere_that_grows_meets_its_neighbour,
           a_hollow_sphere_that_collapses_meets_what_is_inside, a_ball_on_a_screw_meets_the_ceiling,
           a_cylinder_widens_until_its_kink_touches_the_wall, a_rod_bends_up_to_the_ceiling,
           a_wave_rises_to_a_point, a_plank_twists_into_a_peg, keys_of_free_fall_meet_the_ground,
           keys_turn_a_paddle_into_a_peg, a_lattice_that_swells_carries_its_content_along,
           ten_maps_are_composed_as_one, a_track_of_a_thousand_keys_is_cheap)
