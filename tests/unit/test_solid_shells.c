/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/solid_helpers.h"

/* Closed shells, holes, walls and gaps of solids; solid angles of triangles. */

/* --- Not closed ------------------------------------------------------------------------------- */

static void check_refused(const char *surfaces, const char *says)
{
    imp_error error = {IMP_SUCCESS, ""};
    const scene_words w = with_ball(surfaces, (const double[3]){0.125, 0.0625, 0.03125}, 0.01);
    imp_scene *scene = scene_of(w.text);
    const imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = sizeof r};
    ck_assert_int_eq(imp_scene_solve(scene, &options, &r, &error), IMP_ERROR_SCENE);
    ck_assert_msg(strstr(error.text, says) != NULL && strstr(error.text, "body 'a'") != NULL, "%s",
                  error.text);
    imp_scene_free(scene);
}

START_TEST(bodies_that_are_not_closed_are_refused_with_the_place_and_the_number)
{
    check_refused("{\"type\": \"cylinder\", \"radius\": 0.75}", "surface 0, piece 0");
    check_refused("{\"type\": \"cylinder\", \"radius\": 0.75}", "they wind 0.8");
    /* one triangle of the tetrahedron is missing: */
    check_refused("{\"type\": \"mesh\", \"points\": [[-1,-1,-1],[2,0,0],[0,2,0],[0,0,2]], "
                  "\"faces\": [[0,2,1],[0,1,3],[0,3,2]]}",
                  "borders on the edge of surface 0, piece 0, at (");
    check_refused("{\"type\": \"formula\", \"x\": \"(1+v*cos(u/2))*cos(u)\", \"y\": "
                  "\"(1+v*cos(u/2))*sin(u)\", \"z\": \"v*sin(u/2)\", \"domain\": [[0, "
                  "6.283185307179586], [-0.3, 0.3]]}",
                  "not closed");
    /* the Klein bottle of Lawson's immersion, in space: */
    check_refused("{\"type\": \"formula\", \"x\": "
                  "\"(2+cos(u/2)*sin(v)-sin(u/2)*sin(2*v))*cos(u)\", \"y\": "
                  "\"(2+cos(u/2)*sin(v)-sin(u/2)*sin(2*v))*sin(u)\", \"z\": "
                  "\"sin(u/2)*sin(v)+cos(u/2)*sin(2*v)\", \"domain\": [[0, "
                  "6.283185307179586], [0, 6.283185307179586]]}",
                  "have no inside");
}
END_TEST

/* The face at the top is whole; the others are halves, which meet at the middles of its edges. */
START_TEST(halves_of_faces_meet_at_the_edge_of_a_whole_one)
{
    static const char *const face[][3] = {
        {"-1,-1,1", "2,0,0", "0,2,0"}, {"-1,-1,-1", "0,2,0", "1,0,0"},
        {"0,-1,-1", "0,2,0", "1,0,0"}, {"-1,-1,-1", "1,0,0", "0,0,2"},
        {"0,-1,-1", "1,0,0", "0,0,2"}, {"-1,1,-1", "0,0,2", "1,0,0"},
        {"0,1,-1", "0,0,2", "1,0,0"},  {"-1,-1,-1", "0,0,2", "0,1,0"},
        {"-1,0,-1", "0,0,2", "0,1,0"}, {"1,-1,-1", "0,2,0", "0,0,1"},
        {"1,-1,0", "0,2,0", "0,0,1"}};
    char box[2000] = "";
    for (size_t k = 0; k < sizeof face / sizeof *face; ++k) {
        const size_t used = strlen(box);
        snprintf(box + used, sizeof box - used,
                 "%s{\"type\": \"plane\", \"origin\": [%s], \"edge_u\": [%s], \"edge_v\": "
                 "[%s]}",
                 k > 0 ? ", " : "", face[k][0], face[k][1], face[k][2]);
    }
    check_inside(with_ball(box, (const double[3]){0.5, 0.25, 0.125}, 0.01).text);
    check_clear(with_ball(box, (const double[3]){0.5, 0.25, 1.02}, 0.01).text);
}
END_TEST

START_TEST(gaps_up_to_gamma_are_closed)
{
    static const char box[] =
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,%.17g], \"edge_u\": [2,0,0], \"edge_v\": "
        "[0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [0,0,2], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [1,-1,-1], \"edge_u\": [0,2,0], \"edge_v\": [0,0,2]}";
    char text[2000];
    snprintf(text, sizeof text, box, 1 + 9e-7);
    check_inside(with_ball(text, (const double[3]){0.5, 0.25, 0.125}, 0.01).text);
    check_inside(with_ball(text, (const double[3]){0.5, 0.25, 0.98}, 0.01).text);
    check_clear(with_ball(text, (const double[3]){0.5, 0.25, 1.02}, 0.01).text);
    snprintf(text, sizeof text, box, 1 + 1e-5);
    check_refused(text, "not closed");
}
END_TEST

#define TURN "{\"type\": \"rotate\", \"axis\": [1, 2, 3], \"angle\": 1}"

/* A ball in the cavity, and one in the wall at x = `at`. */
static void try_tank(const scene_words *tank, double at, double wall)
{
    check_clear(with_ball(tank->text, (double[3]){0.1, 0, 0}, 0.3).text);
    check_inside(with_ball(tank->text, (double[3]){at, 0, 0}, 0.2 * wall).text);
}

START_TEST(what_a_thin_wall_holds_is_not_in_it)
{
    static const double walls[] = {0.2, 0.1, 0.02};
    for (size_t k = 0; k < sizeof walls / sizeof *walls; ++k) {
        const double w = walls[k], at = 1 - 0.5 * w;
        const scene_words
            round = words(SPHERE("1", "0") ", " SPHERE("%.17g", "0"), 1 - w),
            can = words("{\"type\": \"cylinder\", \"ends\": true}, {\"type\": \"cylinder\", "
                        "\"radius\": %.17g, \"height\": %.17g, \"ends\": true}",
                        1 - w, 2 - 2 * w),
            turned = words(
                "{\"type\": \"box\", \"size\": [2, 2, 2], \"maps\": [" TURN
                "]}, {\"type\": \"box\", \"size\": [%.17g, %.17g, %.17g], \"maps\": [" TURN "]}",
                2 - 2 * w, 2 - 2 * w, 2 - 2 * w);
        try_tank(&round, at, w);
        try_tank(&can, at, w);
        check_clear(with_ball(turned.text, (double[3]){0.1, 0, 0}, 0.3).text);
    }
}
END_TEST

START_TEST(of_shells_that_touch_nothing_is_claimed)
{
    const scene_words ball =
        with_ball(SPHERE("1", "0") ", " SPHERE("0.5", "0.5"), (double[3]){0.5, 0, 0}, 0.1);
    const imp_result r = solve(ball.text);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_UNDECIDED);
    ck_assert_int_eq(r.reason, IMP_REASON_RESOLUTION);
    ck_assert(r.t_lower == 0);
}
END_TEST

START_TEST(closure_tells_shells_and_holes)
{
    imp_scene *scene = scene_of("{\"surfaces\": [" SPHERE("1", "0") ", " SPHERE(
        "1", "4") "]}, {\"surfaces\": [{\"type\": \"cylinder\"}]}, {\"surfaces\": []}");
    imp_closure c = {.struct_size = sizeof c};
    imp_facing facing[2];
    ck_assert_int_eq(imp_scene_get_closure(scene, 0, 0, 1e-6, facing, NULL, NULL, &c, NULL),
                     IMP_SUCCESS);
    ck_assert(c.verdict == IMP_CLOSURE_CLOSED && c.shells == 2);
    ck_assert(facing[0].shell == 0 && facing[1].shell == 1 && facing[1].sign == 1);
    ck_assert_int_eq(imp_scene_get_closure(scene, 1, 0, 1e-6, NULL, NULL, NULL, &c, NULL),
                     IMP_SUCCESS);
    ck_assert(c.verdict == IMP_CLOSURE_OPEN && c.shells == 0 && fabs(c.where[2]) == 1);
    ck_assert_int_eq(imp_scene_get_closure(scene, 2, 0, 1e-6, NULL, NULL, NULL, &c, NULL),
                     IMP_SUCCESS);
    ck_assert(c.verdict == IMP_CLOSURE_EMPTY);
    ck_assert_int_eq(imp_scene_get_closure(scene, 3, 0, 1e-6, NULL, NULL, NULL, &c, NULL),
                     IMP_ERROR_USAGE);
    imp_scene_free(scene);
}
END_TEST

/* --- Solid angles ----------------------------------------------------------------------------- */

static vec3 random_point(uint64_t *state)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = random_between(state, -1, 1);
    return x;
}

static long double dot_long(const long double *a, const long double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static long double angle_long(vec3 x, const vec3 corner[3])
{
    long double p[3][3], length[3];
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) p[k][i] = (long double)corner[k].x[i] - (long double)x.x[i];
        length[k] = sqrtl(dot_long(p[k], p[k]));
    }
    long double n = 0, d = length[0] * length[1] * length[2];
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n += p[0][i] * (p[1][j] * p[2][k] - p[1][k] * p[2][j]);
        d += dot_long(p[i], p[j]) * length[k];
    }
    return 2 * atan2l(n, d);
}

START_TEST(the_solid_angle_of_a_triangle_is_within_its_error)
{
    uint64_t state = suite_seed();
    const int times = suite_times(200000);
    for (int n = 0; n < times; ++n) {
        vec3 corner[3], x = random_point(&state);
        for (int k = 0; k < 3; ++k) corner[k] = random_point(&state);
        if (n % 2 == 0) { /* near the triangle */
            const double near = exp2(-random_between(&state, 1, 45));
            const double u = random_between(&state, -0.1, 1), v = random_between(&state, -0.1, 1);
            const vec3 e = vec3_sub(corner[1], corner[0]), f = vec3_sub(corner[2], corner[0]);
            x = vec3_add(vec3_scale(x, near),
                         vec3_add(corner[0], vec3_add(vec3_scale(e, u), vec3_scale(f, v))));
        }
        enclosed_angle sum = {0, 0};
        solid_angle_add_triangle(&sum, x, corner[0], corner[1], corner[2]);
        const long double exact = angle_long(x, corner);
        ck_assert_msg(fabsl(exact - (long double)sum.angle) <= (long double)sum.error,
                      "seed %llu, draw %d: %.17g, not %.17Lg within %g",
                      (unsigned long long)suite_seed(), n, sum.angle, exact, sum.error);
        ck_assert(n % 2 == 0 || sum.error < 1e-6);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        bodies_that_are_not_closed_are_refused_with_the_place_and_the_number,
        halves_of_faces_meet_at_the_edge_of_a_whole_one,
        gaps_up_to_gamma_are_closed,
        what_a_thin_wall_holds_is_not_in_it,
        of_shells_that_touch_nothing_is_claimed,
        closure_tells_shells_and_holes,
        the_solid_angle_of_a_triangle_is_within_its_error,
    };
    return suite_main_with("solid_shells", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
