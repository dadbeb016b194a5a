/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/query_helpers.h"

/* Earliest contacts that have a closed form. Each: two pipelines, the interval, gamma, the exact
 * time, and by how much earlier the answer may come: gamma over the closing speed, or, where the
 * surfaces only creep up on each other, the time from a gap of gamma to the touch. */

#define MEET(NAME, A, B, FROM, TO, GAMMA, TIME, EARLY)                                             \
    START_TEST(NAME)                                                                               \
    {                                                                                              \
        const question q = {.a = A, .b = B, .t_start = FROM, .t_end = TO, .gamma = GAMMA};         \
        ask_contact(&q, TIME, EARLY);                                                              \
        const question swapped = {.a = B, .b = A, .t_start = FROM, .t_end = TO, .gamma = GAMMA};   \
        ask_contact(&swapped, TIME, EARLY);                                                        \
    }                                                                                              \
    END_TEST

#define MISS(NAME, A, B, FROM, TO, GAMMA)                                                          \
    START_TEST(NAME)                                                                               \
    {                                                                                              \
        const question q = {.a = A, .b = B, .t_start = FROM, .t_end = TO, .gamma = GAMMA};         \
        ask_clear(&q);                                                                             \
    }                                                                                              \
    END_TEST

#define BIG_PLANE(Z) "plane origin=-50,-50," Z " edge_u=100,0,0 edge_v=0,100,0"

/* --- Planes, corners, edges ------------------------------------------------------------------- */

MEET(a_ball_falls_on_a_plane, "sphere center=0.3,0.2,3 ! translate velocity=0,0,-2", BIG_PLANE("0"),
     0, 2, 1e-7, 1, 5.1e-8)
MEET(a_ball_in_free_fall_lands, "sphere center=0,0,6 ! translate offset=[[0,0,0],[0,0,0],[0,0,-5]]",
     BIG_PLANE("0"), 0, 2, 1e-7, 1, 1.1e-8)
MEET(a_thrown_ball_meets_the_plane_on_its_way_up,
     "sphere center=0,0,-3 ! translate offset=[[0,0,0],[0,0,4],[0,0,-1]]", BIG_PLANE("0"), 0, 4,
     1e-7, 0.58578643762690495, 4e-8)
MEET(parallel_planes_meet_everywhere_at_once, "plane origin=0,0,1 ! translate velocity=0,0,-1",
     "plane origin=0.25,0.25,0", 0, 2, 1e-6, 1, 1.01e-6)
MISS(parallel_planes_that_slide_past_stay_apart,
     "plane origin=-3,0,1e-3 ! translate velocity=3,0,0", "plane", 0, 2, 1e-4)
MEET(a_corner_comes_down_on_a_face,
     "triangle points=[[0.2,0.2,1],[1,0.3,2],[0.3,1,2]] ! translate velocity=0,0,-1",
     "triangle points=[[0,0,0],[1,0,0],[0,1,0]]", 0, 2, 1e-8, 1, 1.01e-8)
MEET(an_edge_crosses_an_edge, "segment points=[[-1,0,0],[1,0,0]]",
     "segment points=[[0,-1,1],[0,1,1]] velocities=[[0,0,-2],[0,0,-2]]", 0, 1, 1e-8, 0.5, 5.1e-9)
MEET(an_edge_turning_about_its_end_meets_an_edge, "segment points=[[-1,0.5,0],[1,0.5,0]]",
     "segment points=[[0,0,0],[0,1,0]] ! rotate axis=1,0,0 rate=-1 ! translate offset=[[0,0,0.5]]",
     0, 1.5, 1e-8, 0.78539816339744831, 2e-8)
MEET(a_corner_meets_a_corner, "triangle points=[[0,0,0],[-1,0.2,0],[-1,-0.2,0]]",
     "triangle points=[[1,0,0],[2,0.2,0],[2,-0.2,0]] ! translate velocity=-1,0,0", 0, 2, 1e-8, 1,
     1.01e-8)
MEET(a_point_meets_a_point, "point", "point position=3,4,0 velocity=-3,-4,0", 0, 2, 1e-9, 1, 3e-10)
MISS(a_point_passes_a_point, "point", "point position=-1,1e-3,0 velocity=2,0,0", 0, 1, 1e-4)
MEET(a_bullet_at_a_million_goes_through_no_plate,
     "sphere radius=0.01 center=-1e6,0,0 ! translate velocity=2e6,0,0",
     "plane origin=0,-1,-1 edge_u=0,2,0 edge_v=0,0,2", 0, 1, 1e-4, 0.499999995, 1e-9)
MEET(a_triangle_collapsed_to_a_point_is_met, "triangle points=[[0,0,0],[0,0,0],[0,0,0]]",
     "sphere center=2,0,0 ! translate velocity=-1,0,0", 0, 2, 1e-7, 1, 1.1e-7)

/* --- Round with round ------------------------------------------------------------------------- */

MEET(a_sphere_meets_another_at_its_pole, "sphere",
     "sphere center=0,0,3 ! translate velocity=0,0,-1", 0, 2, 1e-7, 1, 1.1e-7)
MEET(a_sphere_meets_another_at_its_seam, "sphere",
     "sphere center=3,0,0 ! translate velocity=-1,0,0", 0, 2, 1e-7, 1, 1.1e-7)
MEET(a_ball_reaches_the_wall_from_inside, "sphere radius=2",
     "sphere ! translate velocity=0.6,0,0.8", 0, 2, 1e-7, 1, 1.1e-7)
MEET(concentric_spheres_meet_all_over_at_once, "sphere",
     "sphere radius=2 ! map-formula x=x*(1-t/4) y=y*(1-t/4) z=z*(1-t/4)", 0, 3, 1e-4, 2, 2.1e-4)
MEET(identical_surfaces_touch_at_the_start, "torus", "torus", 0, 1, 1e-6, 0, 0)
MEET(a_ball_drops_into_a_ring_and_touches_a_whole_circle, "torus major_radius=2 minor_radius=0.5",
     "sphere radius=1.7 center=0,0,3 ! translate velocity=0,0,-2", 0, 2, 1e-4, 1.0417424305044158,
     1.3e-4)
MEET(a_ball_grows_until_it_fills_the_ring, "torus major_radius=2 minor_radius=0.5",
     "sphere ! map-formula x=x*(1+t) y=y*(1+t) z=z*(1+t)", 0, 1, 1e-4, 0.5, 1.1e-4)
MISS(a_ball_flies_through_a_ring, "torus major_radius=2 minor_radius=0.5",
     "sphere radius=1.4 center=0,0,-4 ! translate velocity=0,0,8", 0, 1, 1e-3)
MEET(linked_rings_pull_tight, "torus major_radius=1 minor_radius=0.25",
     "torus major_radius=1 minor_radius=0.25 ! rotate axis=1,0,0 angle=1.5707963267948966 ! "
     "translate offset=[[1,0,0],[1,0,0]]",
     0, 1, 1e-6, 0.5, 1.1e-6)
MEET(a_cylinder_rolls_up_to_a_cylinder, "cylinder height=4",
     "cylinder height=4 center=3,0,0 ! translate velocity=-1,0,0", 0, 2, 1e-4, 1, 1.01e-4)
MEET(crossed_cylinders_touch_in_a_point, "cylinder height=6",
     "cylinder height=6 ! rotate axis=1,0,0 angle=1.5707963267948966 ! translate "
     "offset=[[3,0,0],[-1,0,0]]",
     0, 2, 1e-6, 1, 1.01e-6)
MEET(a_ball_meets_the_tip_of_a_cone, "cone", "sphere center=0,0,3 ! translate velocity=0,0,-1", 0,
     2, 1e-6, 1, 1.01e-6)
MEET(a_ball_rolls_against_the_flank_of_a_cone, "cone radius=1 height=1",
     "sphere radius=0.5 center=3,0,0.5 ! translate velocity=-2,0,0", 0, 2, 1e-6,
     0.89644660940672627, 8e-7)
MEET(an_ellipsoid_comes_down_flat, "ellipsoid radii=3,2,1 ! translate offset=[[0,0,2],[0,0,-1]]",
     BIG_PLANE("0"), 0, 2, 1e-6, 1, 1.01e-6)
MEET(a_turning_ellipsoid_reaches_the_plane, "ellipsoid radii=2,1,1 ! rotate axis=0,1,0 rate=1",
     BIG_PLANE("-1.5811388300841898"), 0, 1.5, 1e-6, 0.78539816339744831, 2e-6)
MEET(a_turning_superquadric_touches_with_its_corner,
     "superellipsoid radii=1,1,1 exponents=2,2 ! rotate axis=0,1,0 rate=1",
     BIG_PLANE("-0.96592582628906829"), 0.5, 1.5, 1e-6, 1.308996938995747, 5e-6)
MEET(a_paddle_swings_round_and_hits_a_ball,
     "plane origin=0,0,-1 edge_u=2,0,0 edge_v=0,0,2 ! rotate axis=0,0,1 rate=1",
     "sphere radius=0.5 center=0,1,0", 0, 2, 1e-6, 1.0471975511965976, 2e-6)

/* --- Orbits, screws, waves -------------------------------------------------------------------- */

MEET(a_ball_on_an_orbit_comes_round, "sphere radius=0.5 center=2,0,0 ! rotate axis=0,0,1 rate=1",
     "sphere radius=0.5 center=0,2,0", 0, 2, 1e-7, 1.0654358165107394, 2e-7)
MEET(a_propeller_meets_a_post, "segment points=[[0,0,0],[2,0,0]] ! rotate axis=0,0,1 rate=1",
     "segment points=[[1,1,-1],[1,1,1]]", 0, 2, 1e-8, 0.78539816339744831, 1e-8)
MEET(a_helicoid_screws_up_to_a_bead, "formula x=u*cos(2*pi*v+t) y=u*sin(2*pi*v+t) z=v",
     "point position=0.5,0,0.25", 0, 5, 1e-6, 4.7123889803846897, 8e-6)
MEET(a_wave_rises_to_a_point, "ripple size=2,2 amplitude=0.5 wavelength=2 speed=-1",
     "point position=0,0,0.25", 0, 1, 1e-8, 0.16666666666666669, 1.5e-8)
MEET(a_crest_arrives_under_a_point, "ripple size=4,4 amplitude=0.5 wavelength=2 speed=-1",
     "point position=0,0,0.5", 0, 1, 1e-8, 0.5, 2e-4)
MEET(a_sheet_is_lifted_to_a_ball, "formula x=u y=v z=t*exp(-u^2-v^2) domain=[[-2,2],[-2,2]]",
     "sphere radius=0.5 center=0,0,1.25", 0, 1, 1e-6, 0.75, 1.1e-6)

/* --- Hard ones -------------------------------------------------------------------------------- */

MEET(a_needle_found_by_its_bound_not_by_luck,
     "spike radius=1 height=0.5 width=0.002 spikes=[[3.14159,0.3]]",
     "plane origin=-4,-4,-4 edge_u=0,8,0 edge_v=0,0,8 ! translate velocity=3,0,0", 0, 1, 1e-4,
     0.855666, 4e-5)
MEET(osculating_caps_meet_at_last, "formula x=u y=v z=u^2/2+v^2/2 domain=[[-0.5,0.5],[-0.5,0.5]]",
     "formula x=u y=v z=u^2/2+v^2/2-u^4-v^4+0.5-t domain=[[-0.3,0.3],[-0.3,0.3]]", 0, 1, 1e-4,
     0.4838, 2e-4)
MEET(a_moving_kink_is_met_at_its_edge, "formula x=u y=v z=abs(u-0.1*t)+2-t domain=[[-2,2],[-1,1]]",
     "sphere radius=0.5", 0, 1.6, 1e-6, 1.5237849278567879, 1.3e-6)
MEET(surfaces_that_close_in_ever_slower_touch,
     "sphere center=0,0,1 ! translate offset=[[0,0,1],[0,0,-2],[0,0,1]]", BIG_PLANE("0"), 0, 1.5,
     1e-6, 1, 1.1e-3)
MEET(near_touches_come_before_the_real_one,
     "sphere ! map-formula x=x y=y z=z+2.2+cos(6*pi*t)-0.21*t", BIG_PLANE("0"), 0, 2, 1e-6,
     1.1512793622134065, 2.1e-07)
MEET(a_rank_deficient_edge_is_an_edge_all_the_same,
     "formula x=u^3 y=v^3 z=0 domain=[[-1,1],[-1,1]]",
     "sphere radius=0.5 center=0,0,2 ! translate velocity=0,0,-1.5", 0, 2, 1e-6, 1, 7e-7)
MEET(a_rate_without_bound_at_the_start_is_no_obstacle,
     "formula x=u y=v z=sqrt(t) domain=[[-1,1],[-1,1]] time=[0,1]",
     "sphere radius=0.5 center=0,0,1", 0, 1, 1e-6, 0.25, 1.1e-6)
MEET(the_same_far_from_the_origin, "sphere center=1e8,0,0",
     "sphere center=100000003,0,0 ! translate velocity=-1,0,0", 0, 2, 1e-5, 1, 1.1e-5)
MEET(the_same_in_the_small, "sphere radius=9.3132257461547852e-10",
     "sphere radius=9.3132257461547852e-10 center=2.7939677238464355e-09,0,0 ! translate "
     "velocity=-9.3132257461547852e-10,0,0",
     0, 2, 1e-15, 1, 1.1e-6)
MEET(a_patch_of_any_degree_lands,
     "bezier degree=2,2 "
     "points=[[0,0,1],[0,1,1],[0,2,1],[1,0,1],[1,1,-1],[1,2,1],[2,0,1],[2,1,1],[2,2,1]] ! "
     "translate velocity=0,0,-1",
     BIG_PLANE("0"), 0, 1, 1e-6, 0.5, 1.1e-6)

SUITE_MAIN("contacts", a_ball_falls_on_a_plane, a_ball_in_free_fall_lands,
           a_thrown_ball_meets_the_plane_on_its_way_up, parallel_planes_meet_everywhere_at_once,
           parallel_planes_that_slide_past_stay_apart, a_corner_comes_down_on_a_face,
           an_edge_crosses_an_edge, an_edge_turning_about_its_end_meets_an_edge,
           a_corner_meets_a_corner, a_point_meets_a_point, a_point_passes_a_point,
           a_bullet_at_a_million_goes_through_no_plate, a_triangle_collapsed_to_a_point_is_met,
           a_sphere_meets_another_at_its_pole, a_sphere_meets_another_at_its_seam,
           a_ball_reaches_the_wall_from_inside, concentric_spheres_meet_all_over_at_once,
           identical_surfaces_touch_at_the_start,
           a_ball_drops_into_a_ring_and_touches_a_whole_circle,
           a_ball_grows_until_it_fills_the_ring, a_ball_flies_through_a_ring,
           linked_rings_pull_tight, a_cylinder_rolls_up_to_a_cylinder,
           crossed_cylinders_touch_in_a_point, a_ball_meets_the_tip_of_a_cone,
           a_ball_rolls_against_the_flank_of_a_cone, an_ellipsoid_comes_down_flat,
           a_turning_ellipsoid_reaches_the_plane, a_turning_superquadric_touches_with_its_corner,
           a_paddle_swings_round_and_hits_a_ball, a_ball_on_an_orbit_comes_round,
           a_propeller_meets_a_post, a_helicoid_screws_up_to_a_bead, a_wave_rises_to_a_point,
           a_crest_arrives_under_a_point, a_sheet_is_lifted_to_a_ball,
           a_needle_found_by_its_bound_not_by_luck, osculating_caps_meet_at_last,
           a_moving_kink_is_met_at_its_edge, surfaces_that_close_in_ever_slower_touch,
           near_touches_come_before_the_real_one, a_rank_deficient_edge_is_an_edge_all_the_same,
           a_rate_without_bound_at_the_start_is_no_obstacle, the_same_far_from_the_origin,
           the_same_in_the_small, a_patch_of_any_degree_lands)
