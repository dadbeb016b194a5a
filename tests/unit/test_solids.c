/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/solid_helpers.h"

/* Small balls in solids of many types, against closed forms; solids in motion. */

/* Signed distances, negative inside, or at least of that sign and not larger in size. */
static double of_sphere(const double *x)
{
    return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 1;
}

static double of_torus(const double *x) { return hypot(hypot(x[0], x[1]) - 1, x[2]) - 0.3; }

static double of_box(const double *x)
{
    return fmax(fmax(fabs(x[0]) - 1, fabs(x[1]) - 0.75), fabs(x[2]) - 0.5);
}

static double of_capsule(const double *x)
{
    const double along = fmin(fmax(x[0], -0.5), 0.5);
    return sqrt((x[0] - along) * (x[0] - along) + x[1] * x[1] + x[2] * x[2]) - 0.5;
}

static double of_cylinder(const double *x)
{
    return fmax(hypot(x[0], x[1]) - 0.75, fabs(x[2]) - 1);
}

static double of_cone(const double *x)
{
    return fmax((hypot(x[0], x[1]) - (1 - x[2])) / sqrt(2), -x[2]);
}

static double of_hollow(const double *x) { return fmax(of_sphere(x), 0.5 - (1 + of_sphere(x))); }

static double of_two(const double *x)
{
    const double y[3] = {x[0] - 0.4, x[1], x[2]}, z[3] = {x[0] + 0.4, x[1], x[2]};
    return fmin(of_sphere(y), of_sphere(z));
}

/* A cavity in one of two balls that overlap is filled by the other. */
static double of_filled(const double *x)
{
    const double y[3] = {x[0] - 0.7, x[1], x[2]};
    return fmin(of_hollow(x), of_sphere(y));
}

static double of_affine(const double *x) /* (u + v / 2, v, w + u / 4), all in [-1, 1] / 2 */
{
    const double v = x[1], u = x[0] - v / 2, w = x[2] - u / 4;
    return (fmax(fmax(fabs(u), fabs(v)), fabs(w)) - 0.5) / 1.5;
}

static const struct solid_form {
    const char *surfaces;
    double (*distance)(const double *x);
} forms[] = {
    {SPHERE("1", "0"), of_sphere},
    {"{\"type\": \"torus\", \"major_radius\": 1, \"minor_radius\": 0.3}", of_torus},
    {"{\"type\": \"supertoroid\", \"major_radius\": 1, \"minor_radius\": 0.3, \"exponents\": "
     "[1, 1]}",
     of_torus},
    {"{\"type\": \"superellipsoid\", \"exponents\": [1, 1]}", of_sphere},
    {"{\"type\": \"spike\", \"height\": 0}", of_sphere},
    {"{\"type\": \"box\", \"size\": [2, 1.5, 1]}", of_box},
    {"{\"type\": \"capsule\", \"radius\": 0.5, \"from\": [-0.5,0,0], \"to\": [0.5,0,0]}",
     of_capsule},
    {"{\"type\": \"cylinder\", \"radius\": 0.75, \"height\": 2, \"ends\": true}", of_cylinder},
    {"{\"type\": \"cylinder\", \"radius\": 0.75, \"height\": 2}, {\"type\": \"disc\", \"radius\": "
     "0.75, \"center\": [0,0,1]}, {\"type\": \"disc\", \"radius\": 0.75, \"center\": [0,0,-1]}",
     of_cylinder},
    {"{\"type\": \"cone\", \"radius\": 1, \"height\": 1, \"ends\": true}", of_cone},
    {SPHERE("1", "0") ", " SPHERE("0.5", "0"), of_hollow},
    {SPHERE("1", "0.4") ", " SPHERE("1", "-0.4"), of_two},
    {SPHERE("1", "0") ", " SPHERE("0.5", "0") ", " SPHERE("1", "0.7"), of_filled},
    /* two faces are the wrong way round: */
    {"{\"type\": \"mesh\", " CORNERS ", \"faces\": [[0,2,3,1], [4,6,7,5], [0,1,5,4], [2,6,7,3], "
     "[0,4,6,2], [1,5,7,3]]}",
     of_affine},
    /* all are: */
    {"{\"type\": \"mesh\", " CORNERS ", \"faces\": [[0,1,3,2], [4,6,7,5], [0,4,5,1], [2,3,7,6], "
     "[0,2,6,4], [1,5,7,3]]}",
     of_affine},
    {PATCH(P0, P1, P2, P3) ", " PATCH(P4, P5, P6, P7) ", " PATCH(P0, P4, P1, P5) ", " PATCH(
         P2, P6, P3, P7) ", " PATCH(P0, P2, P4, P6) ", " PATCH(P1, P3, P5, P7),
     of_affine},
    /* one face of two, with a T where they meet: */
    {PATCH(P0, P1, P2, P3) ", " PATCH(P4, P5, P6, P7) ", " PATCH(P0, P4, P1, P5) ", " PATCH(
         P2, P6, P3, P7) ", " PATCH(P0, P2, P4,
                                    P6) ", " PATCH(P1, "[0.5,0,-0.375]", P5,
                                                   "[0.5,0,0.625]") ", " PATCH("[0.5,0,-0.375]", P3,
                                                                               "[0.5,0,0.625]", P7),
     of_affine},
};
enum { FORMS = sizeof forms / sizeof forms[0] };

START_TEST(a_small_ball_is_inside_where_the_closed_form_says_so)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < FORMS; ++k) {
        const int times = suite_times(24);
        for (int n = 0; n < times; ++n) {
            double at[3];
            for (int i = 0; i < 3; ++i) at[i] = random_between(&state, -1.4, 1.4);
            const double distance = forms[k].distance(at);
            if (fabs(distance) < 0.002) continue;
            const scene_words w = with_ball(forms[k].surfaces, at, 0.001);
            if (distance < 0)
                check_inside(w.text);
            else
                check_clear(w.text);
        }
    }
}
END_TEST

START_TEST(points_near_the_surface_are_told_apart)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < FORMS; ++k)
        for (int n = 0; n < 3; ++n) {
            double at[3], along[3], in = 0, out = 4;
            do
                for (int i = 0; i < 3; ++i) at[i] = random_between(&state, -1, 1);
            while (forms[k].distance(at) >= 0);
            for (int i = 0; i < 3; ++i) along[i] = random_between(&state, -1, 1);
            while (out - in > 1e-12) {
                double x[3];
                const double middle = in + (out - in) / 2;
                for (int i = 0; i < 3; ++i) x[i] = at[i] + middle * along[i];
                if (forms[k].distance(x) < 0)
                    in = middle;
                else
                    out = middle;
            }
            for (int side = -1; side <= 1; side += 2) {
                double x[3];
                for (int i = 0; i < 3; ++i) x[i] = at[i] + (in + side * 1e-4) * along[i];
                if (!(side * forms[k].distance(x) > 3e-6)) continue;
                const scene_words w = with_ball(forms[k].surfaces, x, 1e-7);
                if (side < 0)
                    check_inside(w.text);
                else
                    check_clear(w.text);
            }
        }
}
END_TEST

START_TEST(solids_in_motion_hold_what_moves_with_them)
{
    static const char maps[] = "\"maps\": [{\"type\": \"rotate\", \"axis\": [1, 2, 3], \"angle\": "
                               "[1, 2]}, {\"type\": \"translate\", \"velocity\": [3, 1, 2]}]";
    for (int hole = 0; hole < 2; ++hole) {
        const scene_words w =
            words("{\"solid\": true, \"surfaces\": [{\"type\": \"torus\", \"major_radius\": 1, "
                  "\"minor_radius\": 0.3}], %s}, {\"surfaces\": [" SPHERE("0.1", "%d") "], %s}",
                  maps, 1 - hole, maps);
        if (hole)
            check_clear(w.text);
        else
            check_inside(w.text);
    }
}
END_TEST

START_TEST(who_comes_from_outside_touches)
{
    const imp_result r =
        solve("{\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}, {\"surfaces\": [" SPHERE(
            "0.1", "3") "], \"maps\": [{\"type\": \"translate\", \"velocity\": [-4, 0, 0]}]}");
    ck_assert(r.verdict == IMP_VERDICT_CONTACT && r.kind == IMP_CONTACT_TOUCH);
    ck_assert(fabs(r.t - 1.9 / 4) < 1e-6);
}
END_TEST

START_TEST(one_part_of_a_body_inside_is_enough)
{
    check_inside("{\"surfaces\": [" SPHERE("0.1", "5") ", " SPHERE(
        "0.1", "0.2") "]}, {\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}");
    check_inside("{\"surfaces\": [{\"type\": \"mesh\", \"points\": [[5,0,0],[6,0,0],[5,1,0],"
                 "[0,0,0],[0.1,0,0],[0,0.1,0]], \"faces\": [[0,1,2],[3,4,5]]}]}, {\"solid\": true, "
                 "\"surfaces\": [" SPHERE("1", "0") "]}");
    check_clear("{\"surfaces\": [" SPHERE("0.1", "5") ", " SPHERE(
        "0.1", "1.2") "]}, {\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}");
}
END_TEST

START_TEST(only_the_outer_body_has_to_be_solid)
{
    check_clear("{\"surfaces\": [" SPHERE("1", "0") "]}, {\"solid\": true, \"surfaces\": [" SPHERE(
        "0.1", "0") "]}");
    check_inside("{\"surfaces\": [" SPHERE(
        "0.1", "0") "]}, {\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_small_ball_is_inside_where_the_closed_form_says_so,
        points_near_the_surface_are_told_apart,
        solids_in_motion_hold_what_moves_with_them,
        who_comes_from_outside_touches,
        one_part_of_a_body_inside_is_enough,
        only_the_outer_body_has_to_be_solid,
    };
    return suite_main_with("solids", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
