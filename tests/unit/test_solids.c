/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdarg.h>

#include "core/solid/winding.h"
#include "tests/support/query_helpers.h"

/* Bodies that are solid: who is inside them when a query begins? */

static imp_registry *registry;

static void open_registry(void) { registry = query_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* --- Asking ----------------------------------------------------------------------------------- */

typedef struct scene_words {
    char text[16384];
} scene_words;

/* A scene of these bodies, as in a scene file. */
__attribute__((format(printf, 1, 2))) static scene_words words(const char *format, ...)
{
    scene_words w;
    va_list rest;
    va_start(rest, format);
    const int n = vsnprintf(w.text, sizeof w.text, format, rest);
    va_end(rest);
    ck_assert_int_lt(n, (int)sizeof w.text);
    return w;
}

static imp_scene *scene_of(const char *bodies)
{
    imp_error error = {IMP_SUCCESS, ""};
    const scene_words w = words("{\"time\": [0, 1], \"bodies\": [%s]}", bodies);
    imp_scene *scene = imp_scene_from_json(registry, w.text, strlen(w.text), "test", &error);
    ck_assert_msg(scene != NULL, "%s: %s", w.text, error.text);
    return scene;
}

static imp_result solve(const char *bodies)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = scene_of(bodies);
    const imp_options options = imp_options_default(scene);
    imp_result r = {.struct_size = sizeof r};
    const imp_code code = imp_scene_solve(scene, &options, &r, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s: %s", bodies, error.text);
    imp_scene_free(scene);
    return r;
}

static bool is_inside(const imp_result *r)
{
    return r->verdict == IMP_VERDICT_CONTACT && r->kind == IMP_CONTACT_INSIDE;
}

static void check_inside(const char *bodies)
{
    const imp_result r = solve(bodies);
    ck_assert_msg(is_inside(&r) && r.t == 0 && r.t_lower == 0 && r.gap == 0 && !r.has_normal,
                  "%s: verdict %d, kind %d", bodies, (int)r.verdict, (int)r.kind);
    ck_assert(isnan(r.a.u) != isnan(r.b.u));
    for (int i = 0; i < 3; ++i) ck_assert(r.a.point[i] == r.b.point[i]);
}

static void check_clear(const char *bodies)
{
    const imp_result r = solve(bodies);
    ck_assert_msg(r.verdict == IMP_VERDICT_CLEAR, "%s: verdict %d, kind %d at %g", bodies,
                  (int)r.verdict, (int)r.kind, r.t);
}

/* Two bodies: a solid one of these surfaces, and a small ball. */
static scene_words with_ball(const char *surfaces, const double at[3], double radius)
{
    return words(
        "{\"name\": \"a\", \"solid\": true, \"surfaces\": [%s]}, {\"surfaces\": [{\"type\": "
        "\"sphere\", \"radius\": %.17g, \"center\": [%.17g, %.17g, %.17g]}]}",
        surfaces, radius, at[0], at[1], at[2]);
}

/* --- Closed forms ----------------------------------------------------------------------------- */

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

#define SPHERE(R, X) "{\"type\": \"sphere\", \"radius\": " R ", \"center\": [" X ", 0, 0]}"
#define CORNERS                                                                                    \
    "\"points\": [[-0.75,-0.5,-0.625], [0.25,-0.5,-0.375], [-0.25,0.5,-0.625], "                   \
    "[0.75,0.5,-0.375], [-0.75,-0.5,0.375], [0.25,-0.5,0.625], [-0.25,0.5,0.375], "                \
    "[0.75,0.5,0.625]]"
/* A face of the parallelepiped, as a bilinear patch from four of its corners. */
#define PATCH(A, B, C, D)                                                                          \
    "{\"type\": \"bezier\", \"degree\": [1, 1], \"points\": [" A ", " B ", " C ", " D "]}"
#define P0 "[-0.75,-0.5,-0.625]"
#define P1 "[0.25,-0.5,-0.375]"
#define P2 "[-0.25,0.5,-0.625]"
#define P3 "[0.75,0.5,-0.375]"
#define P4 "[-0.75,-0.5,0.375]"
#define P5 "[0.25,-0.5,0.625]"
#define P6 "[-0.25,0.5,0.375]"
#define P7 "[0.75,0.5,0.625]"

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
    /* one is there twice: */
    check_refused("{\"type\": \"mesh\", \"points\": [[-1,-1,-1],[2,0,0],[0,2,0],[0,0,2]], "
                  "\"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3],[1,2,3]]}",
                  "one too many");
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

#define CUBE "{\"type\": \"box\", \"size\": [2, 2, 2]}"

START_TEST(shells_that_share_all_edges_with_others_are_never_taken_for_empty)
{
    static const char box[] = "{\"type\": \"box\", \"size\": [1, 1, 1], \"center\": [%d, %d, %d]}";
    char text[8192] = "", *end = text;
    const scene_words twice = words(CUBE ", " CUBE);
    check_refused(twice.text, "bound no volume");
    for (int k = 0; k < 27; ++k) {
        end += sprintf(end, "%s", k > 0 ? ", " : "");
        end += sprintf(end, box, k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    }
    check_refused(text, "bound no volume");
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

/* --- All questions agree ---------------------------------------------------------------------- */

/* Two balls in a solid one of planes, which come near none of its surfaces, and one outside. */
static const char crowd[] =
    "{\"name\": \"box\", \"solid\": true, \"surfaces\": [{\"type\": \"box\", \"size\": [8, 8, "
    "8]}]}, "
    "{\"name\": \"in\", \"surfaces\": [" SPHERE(
        "0.1", "1") "]}, "
                    "{\"name\": \"too\", \"surfaces\": [" SPHERE(
                        "0.1", "2") "]}, "
                                    "{\"name\": \"out\", \"surfaces\": [" SPHERE("0.1", "9") "]}";

START_TEST(excluding_a_pair_finds_the_next_one_inside)
{
    imp_scene *scene = scene_of(crowd);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    for (size_t k = 1; k <= 2; ++k) {
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        imp_result r = imp_query_result(query);
        ck_assert(is_inside(&r) && r.a.body == 0 && r.b.body == k && isnan(r.a.u));
        ck_assert_int_eq(imp_query_refine(query, 1e-7 / (double)k, -1, NULL), IMP_SUCCESS);
        ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
        r = imp_query_result(query);
        ck_assert(is_inside(&r) && r.b.body == k);
        ck_assert_int_eq(imp_query_exclude_pair(query, NULL), IMP_SUCCESS);
    }
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_query_result(query).verdict, IMP_VERDICT_CLEAR);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(parts_of_a_query_tell_who_is_inside)
{
    imp_scene *scene = scene_of(crowd);
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_query_new(scene, &options, NULL);
    size_t count, inside = 0;
    ck_assert_int_eq(imp_query_divide(query, &count, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < count; ++k) {
        imp_query *part = imp_query_part(query, k, NULL);
        ck_assert_int_eq(imp_query_step(part, 0, NULL), IMP_SUCCESS);
        const imp_result r = imp_query_result(part);
        inside += is_inside(&r);
        imp_query_free(part);
    }
    ck_assert_uint_eq(inside, 2);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

static void check_clearance(imp_scene *scene, const imp_clearance_options *asked, size_t pairs,
                            size_t inside)
{
    const imp_options options = imp_options_default(scene);
    imp_query *query = imp_clearance_new(scene, &options, asked, NULL);
    size_t found = 0;
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_uint_eq(imp_clearance_count(query), pairs);
    for (size_t k = 0; k < pairs; ++k) {
        imp_clearance a = {.struct_size = sizeof a};
        ck_assert_int_eq(imp_clearance_get(query, k, &a, NULL), IMP_SUCCESS);
        if (a.kind != IMP_CONTACT_INSIDE) continue;
        found += 1;
        ck_assert(a.lower == 0 && a.upper == 0 && a.has_witness && a.reason == IMP_REASON_NONE);
        ck_assert(a.t == a.t_start);
        if (asked->required == 0) continue;
        ck_assert_int_eq(a.verdict, IMP_REQUIREMENT_VIOLATED);
        ck_assert(asked->slices > 1 || (a.t_violated == 0 && a.gap_violated == 0));
    }
    ck_assert_uint_eq(found, inside);
    imp_query_free(query);
}

START_TEST(clearances_are_zero_inside)
{
    imp_scene *scene = scene_of(crowd);
    imp_clearance_options asked = imp_clearance_options_default();
    check_clearance(scene, &asked, 1, 1);
    asked.required = 0.01;
    check_clearance(scene, &asked, 1, 1);
    asked.decide = true;
    check_clearance(scene, &asked, 1, 1);
    asked.slices = 3;
    check_clearance(scene, &asked, 3, 3);
    asked.slices = 1;
    asked.each = true;
    check_clearance(scene, &asked, 6, 2);
    asked.within = 0.01;
    check_clearance(scene, &asked, 2, 2);
    imp_scene_free(scene);
}
END_TEST

/* A ball comes from outside, and is inside during the last slices, where it touches nothing. */
START_TEST(slices_of_time_that_begin_inside_have_no_distance)
{
    imp_scene *scene =
        scene_of("{\"solid\": true, \"surfaces\": [" SPHERE("1", "0") "]}, {\"surfaces\": [" SPHERE(
            "0.1", "3") "], \"maps\": [{\"type\": \"translate\", \"velocity\": [-3, 0, 0]}]}");
    const imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = 30;
    imp_query *query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < 30; ++k) {
        imp_clearance a = {.struct_size = sizeof a};
        ck_assert_int_eq(imp_clearance_get(query, k, &a, NULL), IMP_SUCCESS);
        const bool apart = 3 - 3 * a.t_end > 1.1, inside = 3 - 3 * a.t_start < 0.89;
        ck_assert_msg(apart == (a.lower > 0.01), "slice %zu: %g", k, a.lower);
        ck_assert(!inside || a.kind == IMP_CONTACT_INSIDE);
    }
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* A box whose lid is 0.018 too high, which gamma closes: a ball passes the gap. */
START_TEST(a_slice_that_begins_behind_a_gap_begins_inside)
{
    imp_scene *scene = scene_of(
        "{\"solid\": true, \"surfaces\": ["
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,1.018], \"edge_u\": [2,0,0], \"edge_v\": "
        "[0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,1,-1], \"edge_u\": [2,0,0], \"edge_v\": [0,0,2]}, "
        "{\"type\": \"plane\", \"origin\": [-1,-1,-1], \"edge_u\": [0,0,2], \"edge_v\": [0,2,0]}, "
        "{\"type\": \"plane\", \"origin\": [1,-1,-1], \"edge_u\": [0,2,0], \"edge_v\": [0,0,2]}]}, "
        "{\"surfaces\": [{\"type\": \"sphere\", \"radius\": 0.001, \"center\": [1.4, 0, 1.209]}], "
        "\"maps\": [{\"type\": \"translate\", \"velocity\": [-1.2, 0, -0.6]}]}");
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance a[2] = {{.struct_size = sizeof *a}, {.struct_size = sizeof *a}};
    options.gamma = 0.02;
    asked.slices = 2;
    imp_query *query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    for (size_t k = 0; k < 2; ++k)
        ck_assert_int_eq(imp_clearance_get(query, k, &a[k], NULL), IMP_SUCCESS);
    ck_assert(a[0].lower > 0);
    ck_assert(a[1].lower == 0 && a[1].kind == IMP_CONTACT_INSIDE);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_limit_of_time_ends_the_look_inside)
{
    imp_scene *scene = scene_of(crowd);
    imp_options options = imp_options_default(scene);
    options.max_seconds = 1e-9;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    const imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_SECONDS);
    ck_assert(r.t_lower == 0);
    imp_query_free(query);
    imp_scene_free(scene);
}
END_TEST

/* A solid of many balls side by side, and a small ball in one of them. */
static imp_scene *many_balls(bool solid)
{
    enum { BALLS = 200 };
    char balls[60 * BALLS];
    size_t length = 0;
    for (int k = 0; k < BALLS; ++k)
        length += (size_t)snprintf(balls + length, sizeof balls - length,
                                   "%s{\"type\":\"sphere\",\"center\":[%d,0,0]}", k > 0 ? "," : "",
                                   3 * k);
    return scene_of(words("{\"surfaces\":[%s]%s},{\"surfaces\":[{\"type\":\"sphere\","
                          "\"radius\":0.1,\"center\":[30,0,0]}]}",
                          balls, solid ? ",\"solid\":true" : "")
                        .text);
}

START_TEST(a_limit_of_memory_ends_the_look_inside)
{
    uint64_t bytes[2];
    for (int solid = 0; solid < 2; ++solid) {
        imp_scene *scene = many_balls(solid);
        const imp_options options = imp_options_default(scene);
        imp_result r = {.struct_size = sizeof r};
        ck_assert_int_eq(imp_scene_solve(scene, &options, &r, NULL), IMP_SUCCESS);
        ck_assert(is_inside(&r) == solid);
        bytes[solid] = r.stats.bytes;
        imp_scene_free(scene);
    }
    ck_assert_uint_gt(bytes[1], bytes[0] + 200 * 500);
    imp_scene *scene = many_balls(true);
    imp_options options = imp_options_default(scene);
    options.max_bytes = (bytes[0] + bytes[1]) / 2;
    imp_query *query = imp_query_new(scene, &options, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    imp_result r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    ck_assert(r.t_lower == 0);
    imp_query_free(query);
    const imp_clearance_options asked = imp_clearance_options_default();
    query = imp_clearance_new(scene, &options, &asked, NULL);
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    r = imp_query_result(query);
    ck_assert(r.verdict == IMP_VERDICT_UNDECIDED && r.reason == IMP_REASON_MEMORY);
    imp_query_free(query);
    options.max_bytes = 0;
    query = imp_clearance_new(scene, &options, &asked, NULL);
    imp_clearance found = {.struct_size = sizeof found};
    ck_assert_int_eq(imp_query_step(query, 0, NULL), IMP_SUCCESS);
    ck_assert_int_eq(imp_clearance_get(query, 0, &found, NULL), IMP_SUCCESS);
    ck_assert(found.upper == 0);
    imp_query_free(query);
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
        a_small_ball_is_inside_where_the_closed_form_says_so,
        points_near_the_surface_are_told_apart,
        solids_in_motion_hold_what_moves_with_them,
        who_comes_from_outside_touches,
        one_part_of_a_body_inside_is_enough,
        only_the_outer_body_has_to_be_solid,
        bodies_that_are_not_closed_are_refused_with_the_place_and_the_number,
        shells_that_share_all_edges_with_others_are_never_taken_for_empty,
        gaps_up_to_gamma_are_closed,
        what_a_thin_wall_holds_is_not_in_it,
        of_shells_that_touch_nothing_is_claimed,
        closure_tells_shells_and_holes,
        excluding_a_pair_finds_the_next_one_inside,
        parts_of_a_query_tell_who_is_inside,
        clearances_are_zero_inside,
        slices_of_time_that_begin_inside_have_no_distance,
        a_slice_that_begins_behind_a_gap_begins_inside,
        a_limit_of_time_ends_the_look_inside,
        a_limit_of_memory_ends_the_look_inside,
        the_solid_angle_of_a_triangle_is_within_its_error};
    return suite_main_with("solids", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
