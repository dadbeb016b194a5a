/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/surface/region.h"
#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/query_helpers.h"

/* Surfaces of Loop's scheme against points that repeated subdivision leads to. */

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

/* --- Triangles, subdivided in the simplest way ------------------------------------------------ */

enum { POINTS = 20000, FACES = 20000 };

/* Each corner of a face also has barycentric coordinates in one of the faces `of` which the mesh
 * came. */
typedef struct triangle_list {
    int points, faces;
    double x[POINTS][3];
    int corner[FACES][3], of[FACES];
    double at[FACES][3][3];
} triangle_list;

static triangle_list *list_new(void)
{
    triangle_list *m = calloc(1, sizeof *m);
    ck_assert_ptr_nonnull(m);
    return m;
}

static void begin_coordinates(triangle_list *m)
{
    for (int f = 0; f < m->faces; ++f) {
        m->of[f] = f;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) m->at[f][k][j] = k == j;
    }
}

/* The corner of a face before the edge from a to b; -1: no face has it. */
static int across(const triangle_list *m, int a, int b)
{
    for (int f = 0; f < m->faces; ++f)
        for (int k = 0; k < 3; ++k)
            if (m->corner[f][k] == a && m->corner[f][(k + 1) % 3] == b)
                return m->corner[f][(k + 2) % 3];
    return -1;
}

/* The share of the neighbours' mean in what a point becomes, or in its limit. */
static double share_of(int n, bool is_limit)
{
    const double x = 0.375 + 0.25 * cos(2 * acos(-1) / n), share = 0.625 - x * x;
    return is_limit ? 1 / (1 + 3 / (8 * share)) : share;
}

static void smooth(const triangle_list *m, int p, bool is_limit, double x[3])
{
    double around[3] = {0, 0, 0}, border[3] = {0, 0, 0};
    int n = 0, ends = 0;
    for (int f = 0; f < m->faces; ++f)
        for (int k = 0; k < 3; ++k) {
            if (m->corner[f][k] != p) continue;
            const int next = m->corner[f][(k + 1) % 3], last = m->corner[f][(k + 2) % 3];
            n += 1;
            for (int i = 0; i < 3; ++i) around[i] += m->x[next][i];
            for (int side = 0; side < 2; ++side) {
                const int q = side ? last : next;
                if (across(m, side ? p : q, side ? q : p) >= 0) continue;
                ends += 1;
                for (int i = 0; i < 3; ++i) border[i] += m->x[q][i];
            }
        }
    for (int i = 0; i < 3; ++i) {
        const double own = m->x[p][i];
        if (ends == 0)
            x[i] = own + share_of(n, is_limit) * (around[i] / n - own);
        else if (n == 1)
            x[i] = own;
        else
            x[i] = is_limit ? (4 * own + border[i]) / 6 : (6 * own + border[i]) / 8;
    }
}

static int edge_point(const triangle_list *m, int a, int b, triangle_list *to, int (*ends)[2])
{
    for (int p = m->points; p < to->points; ++p)
        if ((ends[p][0] == a && ends[p][1] == b) || (ends[p][0] == b && ends[p][1] == a)) return p;
    const int c = across(m, a, b), d = across(m, b, a), p = to->points++;
    ck_assert_int_lt(p, POINTS);
    ends[p][0] = a, ends[p][1] = b;
    for (int i = 0; i < 3; ++i)
        to->x[p][i] = c < 0 || d < 0
                          ? (m->x[a][i] + m->x[b][i]) / 2
                          : (3 * m->x[a][i] + 3 * m->x[b][i] + m->x[c][i] + m->x[d][i]) / 8;
    return p;
}

static void add_face(const triangle_list *m, int f, triangle_list *to, const int corner[3],
                     double at[3][3])
{
    const int g = to->faces++;
    ck_assert_int_lt(g, FACES);
    memcpy(to->corner[g], corner, sizeof to->corner[g]);
    memcpy(to->at[g], at, sizeof to->at[g]);
    to->of[g] = m->of[f];
}

/* Numbers points as the plugin does: each face's corners, then its middle. */
static triangle_list *step(const triangle_list *m)
{
    triangle_list *to = list_new();
    int(*ends)[2] = calloc(POINTS, sizeof *ends);
    to->points = m->points;
    for (int p = 0; p < m->points; ++p) smooth(m, p, false, to->x[p]);
    for (int f = 0; f < m->faces; ++f) {
        const int *c = m->corner[f];
        int edge[3];
        double at[3][3];
        for (int k = 0; k < 3; ++k) {
            edge[k] = edge_point(m, c[k], c[(k + 1) % 3], to, ends);
            for (int j = 0; j < 3; ++j) at[k][j] = (m->at[f][k][j] + m->at[f][(k + 1) % 3][j]) / 2;
        }
        for (int k = 0; k < 3; ++k) {
            double own[3][3];
            memcpy(own[0], m->at[f][k], sizeof own[0]);
            memcpy(own[1], at[k], sizeof own[1]);
            memcpy(own[2], at[(k + 2) % 3], sizeof own[2]);
            add_face(m, f, to, (const int[]){c[k], edge[k], edge[(k + 2) % 3]}, own);
        }
        add_face(m, f, to, edge, at);
    }
    free(ends);
    return to;
}

/* --- Meshes ----------------------------------------------------------------------------------- */

static void set_corners(triangle_list *m, int a, int b, int c)
{
    m->corner[m->faces][0] = a, m->corner[m->faces][1] = b, m->corner[m->faces++][2] = c;
}

/* n triangles around point 0, all around it unless open; and around a second tip beneath. */
static triangle_list *cone(int n, bool is_open, bool has_two_tips)
{
    triangle_list *m = list_new();
    const int tip = n + 1 + is_open; /* the second */
    m->points = tip + has_two_tips;
    for (int k = 0; k < n; ++k) {
        const int next = k + 1 == n && !is_open ? 1 : k + 2;
        set_corners(m, 0, k + 1, next);
        if (has_two_tips) set_corners(m, tip, next, k + 1);
    }
    return m;
}

static void draw_points(triangle_list *m, uint64_t *random)
{
    for (int p = 0; p < m->points; ++p)
        for (int i = 0; i < 3; ++i) m->x[p][i] = random_between(random, -1, 1);
}

static instance surface_of(const triangle_list *m)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "{\"scheme\": \"loop\", \"points\": [");
    for (int p = 0; p < m->points; ++p)
        fprintf(out, "%s[%.17g,%.17g,%.17g]", p > 0 ? "," : "", m->x[p][0], m->x[p][1], m->x[p][2]);
    fprintf(out, "], \"faces\": [");
    for (int f = 0; f < m->faces; ++f)
        fprintf(out, "%s[%d,%d,%d]", f > 0 ? "," : "", m->corner[f][0], m->corner[f][1],
                m->corner[f][2]);
    fprintf(out, "]}");
    fclose(out);
    uint64_t random = suite_seed();
    instance made = instance_make(registry, "subdivision", text, &random);
    free(text);
    return made;
}

static size_t piece_count(const instance *made) { return made->surface->piece_count(made->self); }

static void point_of(const instance *made, int piece, double u, double v, double x[3])
{
    double error[3];
    const double p[3] = {u, v, 0};
    const void *self = made->surface->piece(made->self, (size_t)piece);
    ck_assert_int_eq(made->surface->eval(self, 1, p, x, error), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) ck_assert_double_le(error[i], 1e-12);
}

/* --- What the surface is ---------------------------------------------------------------------- */

/* Checks limit points of a mesh whose faces are the pieces in their order, each with its first
 * corner at (0, 0). */
static void check_limits(const triangle_list *pieces, const instance *made, int steps)
{
    triangle_list *m = list_new();
    *m = *pieces;
    begin_coordinates(m);
    for (int k = 0; k < steps; ++k) {
        triangle_list *finer = step(m);
        free(m);
        m = finer;
    }
    for (int f = 0; f < m->faces; ++f) {
        const double *at = m->at[f][f % 3], u = 1 - at[0];
        double limit[3], x[3];
        smooth(m, m->corner[f][f % 3], true, limit);
        point_of(made, m->of[f], u, u > 0 ? at[2] / u : 0.5, x);
        for (int i = 0; i < 3; ++i)
            ck_assert_msg(fabs(x[i] - limit[i]) < 1e-13, "piece %d at %g, %g: %g, limit %g",
                          m->of[f], u, at[2] / u, x[i], limit[i]);
    }
    free(m);
}

/* A mesh of which each face has two extraordinary corners or more is subdivided once by the
 * plugin. */
static void check_mesh(triangle_list *m, int steps)
{
    uint64_t random = suite_seed() + (uint64_t)m->faces;
    draw_points(m, &random);
    instance made = surface_of(m);
    begin_coordinates(m);
    triangle_list *pieces = step(m);
    ck_assert_uint_eq(piece_count(&made), (size_t)pieces->faces);
    check_limits(pieces, &made, steps);
    instance_free(&made);
    free(pieces);
    free(m);
}

START_TEST(points_are_limits_of_subdivision_at_corners_of_any_valence)
{
    const int valence[] = {3, 4, 5, 7, 8, 12};
    for (size_t k = 0; k < sizeof valence / sizeof *valence; ++k)
        check_mesh(cone(valence[k], false, true), 2);
    check_mesh(cone(40, false, true), 1);
}
END_TEST

/* Open and closed fans, whose corners at the border have two faces, or one, or n. */
START_TEST(points_are_limits_of_subdivision_at_borders)
{
    check_mesh(cone(2, true, false), 3);
    check_mesh(cone(4, true, false), 3);
    check_mesh(cone(5, true, false), 3);
    check_mesh(cone(4, true, true), 3);
    check_mesh(cone(5, false, false), 3);
}
END_TEST

enum { SIDE = 6 };

/* Points (i, j) of a grid of triangles; x^2 has the control values i^2 - 1/3, and x y has i j +
 * 1/6. */
static triangle_list *grid(void)
{
    triangle_list *m = list_new();
    m->points = (SIDE + 1) * (SIDE + 1);
    for (int p = 0; p < m->points; ++p) {
        const double i = p / (SIDE + 1), j = p % (SIDE + 1);
        m->x[p][0] = i, m->x[p][1] = j, m->x[p][2] = i * i - 1. / 3 + 2 * (i * j + 1. / 6) - j;
    }
    for (int i = 0; i < SIDE; ++i)
        for (int j = 0; j < SIDE; ++j) {
            const int p = i * (SIDE + 1) + j;
            set_corners(m, p, p + SIDE + 1, p + 1);
            set_corners(m, p + SIDE + 2, p + 1, p + SIDE + 1);
        }
    return m;
}

START_TEST(a_regular_grid_is_a_quartic_box_spline)
{
    triangle_list *m = grid();
    instance made = surface_of(m);
    for (int k = 0; k < 2 * SIDE * SIDE; ++k) {
        const int i = k / 2 / SIDE, j = k / 2 % SIDE;
        if (i == 0 || j == 0 || i == SIDE - 1 || j == SIDE - 1) continue;
        for (int n = 0; n < 16; ++n) {
            double x[3];
            point_of(&made, k, n % 4 / 3., n / 4 / 3., x);
            ck_assert_double_eq_tol(x[2], x[0] * x[0] + 2 * x[0] * x[1] - x[1], 1e-13);
            const double b = n % 4 / 3. * (1 - n / 4 / 3.), c = n % 4 / 3. * (n / 4 / 3.);
            ck_assert_double_eq_tol(x[0], k % 2 ? i + 1 - b : i + b, 1e-14);
            ck_assert_double_eq_tol(x[1], k % 2 ? j + 1 - c : j + c, 1e-14);
        }
    }
    instance_free(&made);
    free(m);
}
END_TEST

/* The border is the cubic B-spline of the border's points. */
START_TEST(the_border_does_not_depend_on_the_inside)
{
    for (int which = 0; which < 2; ++which) {
        triangle_list *m = grid();
        m->x[SIDE + 2][2] = which ? 30 : 0; /* (1, 1) */
        instance made = surface_of(m);
        double x[3];
        const double *z[3] = {m->x[0], m->x[SIDE + 1], m->x[2 * (SIDE + 1)]};
        point_of(&made, 0, 1, 0, x);
        ck_assert_double_eq_tol(x[2], (z[0][2] + 4 * z[1][2] + z[2][2]) / 6, 1e-11);
        instance_free(&made);
        free(m);
    }
}
END_TEST

/* --- Contacts --------------------------------------------------------------------------------- */

#define OCTAHEDRON                                                                                 \
    "subdivision scheme=loop points=[[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]] "         \
    "faces=[[0,2,4],[2,1,4],[1,3,4],[3,0,4],[2,0,5],[1,2,5],[3,1,5],[0,3,5]]"

/* With n = 4 the share is 5/8 - 9/64 = 31/64, so the limit of (1,0,0) is 1 - 1 / (1 + 24/31) =
 * 24/55. */
START_TEST(contact_at_an_extraordinary_point_comes_at_its_time)
{
    imp_result r = query_audited(OCTAHEDRON, "point position=2,0,0 velocity=-2,0,0");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq_tol(r.t, 1 - 12. / 55, 1e-9);
    r = query_audited(OCTAHEDRON " velocities=[[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0]]",
                      "point position=2,0,0 velocity=-1,0,0");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq_tol(r.t, 1 - 12. / 55, 1e-9);
}
END_TEST

/* A double cone: tips at (0, 0, 1) and (0, 0, -1), n points around them. */
static char *double_cone(int n)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "subdivision scheme=loop points=[[0,0,1],[0,0,-1]");
    for (int k = 0; k < n; ++k) {
        const double angle = 2 * acos(-1) * k / n;
        fprintf(out, ",[%.17g,%.17g,0]", cos(angle), sin(angle));
    }
    fprintf(out, "] faces=[");
    for (int k = 0; k < n; ++k) {
        const int next = k + 1 < n ? k + 3 : 2;
        fprintf(out, "%s[0,%d,%d],[1,%d,%d]", k > 0 ? "," : "", k + 2, next, next, k + 2);
    }
    fprintf(out, "]");
    fclose(out);
    return text;
}

START_TEST(contact_at_a_tip_of_any_valence_comes_at_its_time)
{
    const int valence[] = {3, 5, 7, 12, 60};
    for (size_t k = 0; k < sizeof valence / sizeof *valence; ++k) {
        char *cone = double_cone(valence[k]);
        const double height = 1 - share_of(valence[k], true);
        const imp_result r = query_audited(cone, "point position=0,0,2 velocity=0,0,-2");
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_double_eq_tol(r.t, 1 - height / 2, 1e-9);
        free(cone);
    }
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        points_are_limits_of_subdivision_at_corners_of_any_valence,
        points_are_limits_of_subdivision_at_borders,
        a_regular_grid_is_a_quartic_box_spline,
        the_border_does_not_depend_on_the_inside,
        contact_at_an_extraordinary_point_comes_at_its_time,
        contact_at_a_tip_of_any_valence_comes_at_its_time,
    };
    return suite_main_with("loop", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
