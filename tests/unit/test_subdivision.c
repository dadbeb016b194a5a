/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/surface/region.h"
#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/query_helpers.h"

/* Catmull-Clark surfaces whose points are known, and what holds of all pieces of any, of Loop's as
 * well. That the first piece's bounds hold against an oracle is tested with all other types in
 * test_plugins.c. */

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

#define CUBE_POINTS "[[-1,-1,-1],[1,-1,-1],[-1,1,-1],[1,1,-1],[-1,-1,1],[1,-1,1],[-1,1,1],[1,1,1]]"
#define CUBE_FACES "[[0,2,3,1],[4,5,7,6],[0,1,5,4],[2,6,7,3],[0,4,6,2],[1,3,7,5]]"
#define CUBE "\"points\": " CUBE_POINTS ", \"faces\": " CUBE_FACES

static instance made_of(const char *parameters)
{
    uint64_t random = suite_seed();
    return instance_make(registry, "subdivision", parameters, &random);
}

static size_t piece_count(const instance *made) { return made->surface->piece_count(made->self); }

static const void *piece_of(const instance *made, size_t k)
{
    return made->surface->piece(made->self, k);
}

static void point_of(const instance *made, size_t piece, double u, double v, double x[3],
                     double error[3])
{
    const double p[3] = {u, v, 0.5};
    ck_assert_int_eq(made->surface->eval(piece_of(made, piece), 1, p, x, error), IMP_STATUS_OK);
}

/* --- Surfaces that are known ------------------------------------------------------------------ */

enum { SIDE = 7 };

/* Points (i, j, i^2 + i j - 1/3 - i), i and j from 0: B-splines make (x, y, x^2 + x y - x) of them,
 * as the square of the spline's parameter has the control values i^2 - 1/3. */
static char *parabola_text(void)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fprintf(out, "{\"points\": [");
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const int i = k / SIDE, j = k % SIDE;
        fprintf(out, "%s[%d,%d,%.17g]", k > 0 ? "," : "", i, j, i * i + i * j - i - 1. / 3);
    }
    fprintf(out, "], \"faces\": [");
    for (int k = 0; k < (SIDE - 1) * (SIDE - 1); ++k) {
        const int at = k / (SIDE - 1) * SIDE + k % (SIDE - 1);
        fprintf(out, "%s[%d,%d,%d,%d]", k > 0 ? "," : "", at, at + SIDE, at + SIDE + 1, at + 1);
    }
    fprintf(out, "]}");
    fclose(out);
    return text;
}

START_TEST(a_regular_grid_is_a_uniform_bicubic_spline)
{
    char *text = parabola_text();
    instance made = made_of(text);
    ck_assert_uint_eq(piece_count(&made), (SIDE - 1) * (SIDE - 1));
    for (size_t k = 0; k < piece_count(&made); ++k) {
        const size_t i = k / (SIDE - 1), j = k % (SIDE - 1);
        if (i == 0 || j == 0 || i == SIDE - 2 || j == SIDE - 2) continue;
        for (int n = 0; n <= 16; ++n) {
            double x[3], error[3];
            point_of(&made, k, n % 4 / 3., n / 4 / 4., x, error);
            ck_assert_double_eq_tol(x[0], (double)i + n % 4 / 3., 1e-14);
            ck_assert_double_eq_tol(x[1], (double)j + n / 4 / 4., 1e-14);
            ck_assert_double_eq_tol(x[2], x[0] * x[0] + x[0] * x[1] - x[0], 2e-13);
        }
    }
    instance_free(&made);
    free(text);
}
END_TEST

/* The border is the cubic B-spline of the border's points, which ends in the corners. */
START_TEST(a_border_is_a_cubic_spline_that_ends_at_corners)
{
    instance made = made_of("{\"points\": [[0,0,5],[1,0,7],[2,0,0],[0,1,1],[1,1,2],[2,1,9]],"
                            " \"faces\": [[0,1,4,3],[1,2,5,4]]}");
    const double z[3] = {5, 7, 0};
    double x[3], error[3];
    point_of(&made, 0, 0, 0, x, error);
    ck_assert_double_le(fabs(x[0]) + fabs(x[1]), 1e-15);
    ck_assert_double_eq_tol(x[2], 5, 1e-14);
    point_of(&made, 0, 1, 0, x, error);
    ck_assert_double_eq_tol(x[2], (z[0] + 4 * z[1] + z[2]) / 6, 1e-14);
    point_of(&made, 0, 0.5, 0, x,
             error); /* (p_-1 + 23 p_0 + 23 p_1 + p_2) / 48, p_-1 = 2 p_0 - p_1 */
    ck_assert_double_eq_tol(x[2], (25 * z[0] + 22 * z[1] + z[2]) / 48, 1e-14);
    point_of(&made, 1, 1, 1, x, error);
    ck_assert_double_eq_tol(x[2], 9, 2e-14);
    instance_free(&made);
}
END_TEST

/* At its corners (3,3,3) / 6, in the middle of its faces (0, 0, 68 / 81). */
START_TEST(a_cube_has_its_known_limit_points)
{
    instance made = made_of("{" CUBE "}");
    ck_assert_uint_eq(piece_count(&made), 24);
    for (size_t k = 0; k < 24; ++k) {
        double x[3], error[3];
        point_of(&made, k, 0, 0, x, error);
        for (int i = 0; i < 3; ++i) {
            ck_assert_double_eq_tol(fabs(x[i]), 0.5, 1e-15);
            ck_assert_double_le(error[i], 1e-14);
        }
        point_of(&made, k, 1, 1, x, error);
        int zeros = 0;
        for (int i = 0; i < 3; ++i) {
            zeros += fabs(x[i]) < 1e-15;
            ck_assert(fabs(x[i]) < 1e-15 || fabs(fabs(x[i]) - 68. / 81) < 1e-15);
        }
        ck_assert_int_eq(zeros, 2);
    }
    instance_free(&made);
}
END_TEST

/* Six triangles around a point: of the three quads of each, that in the middle has two
 * extraordinary corners, and is divided again. */
START_TEST(a_plane_mesh_stays_in_its_plane)
{
    instance made = made_of("{\"points\": [@4[?,?,0.25],[0,0,0.25],@3[?,?,0.25]],"
                            " \"faces\": [[0,1,4],[1,2,4],[2,3,4],[3,5,4],[5,6,4],[6,0,4]]}");
    ck_assert_uint_eq(piece_count(&made), 6 * (2 + 4));
    const imp_region whole = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    for (size_t k = 0; k < piece_count(&made); ++k) {
        imp_model model[3];
        double x[3], error[3];
        point_of(&made, k, 0.01, 0.3, x, error);
        ck_assert_double_eq_tol(x[2], 0.25, 1e-15);
        ck_assert_int_eq(made.surface->include(piece_of(&made, k), &whole, model), IMP_STATUS_OK);
        ck_assert_double_le(model[2].hi - model[2].lo, 1e-12);
    }
    instance_free(&made);
}
END_TEST

/* --- All pieces ------------------------------------------------------------------------------- */

static const char *const meshes[] = {
    "{" CUBE ", \"velocities\": [@8[?,?,?]]}",
    "{\"points\": [@4[?,?,?]], \"velocities\": [@4[?,?,?]], \"faces\": "
    "[[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}",
    "{\"points\": [@11[?,?,?]], \"faces\": [[0,1,2,3],[0,3,4,5],[0,5,6,7],[0,7,8,9],[0,9,10,1]]}",
    "{\"points\": [@8[?,?,?]], \"velocities\": [@8[?,?,?]], \"faces\": "
    "[[2,3,0,1],[0,3,4,5],[7,0,5,6]]}",
    /* two quads that have all four edges in common */
    "{\"points\": [@4[?,?,?]], \"faces\": [[0,1,2,3],[3,2,1,0]]}",
    /* of Loop's: 4, 3 and 12 faces at a point, and at the border 2 and 4 */
    "{\"scheme\": \"loop\", \"points\": [@6[?,?,?]], \"velocities\": [@6[?,?,?]], \"faces\": "
    "[[0,1,2],[0,2,3],"
    "[0,3,4],[0,4,1],[5,2,1],[5,3,2],[5,4,3],[5,1,4]]}",
    "{\"scheme\": \"loop\", \"points\": [@4[?,?,?]], \"faces\": [[0,2,1],[0,1,3],[0,3,2],[1,2,3]]}",
    "{\"scheme\": \"loop\", \"points\": [@13[?,?,?]], \"faces\": "
    "[[0,1,2],[0,2,3],[0,3,4],[0,4,5],[0,5,6],[0,6,7],"
    "[0,7,8],[0,8,9],[0,9,10],[0,10,11],[0,11,12],[0,12,1]]}",
    "{\"scheme\": \"loop\", \"points\": [@6[?,?,?]], \"velocities\": [@6[?,?,?]], \"faces\": "
    "[[0,1,2],[0,2,3],"
    "[0,3,4],[0,4,5]]}",
    "{\"scheme\": \"loop\", \"points\": [@6[?,?,?]], \"faces\": [[1,4,3],[0,1,3],[1,2,4],[3,4,5]]}",
};
enum { MESHES = sizeof meshes / sizeof *meshes, CLOSED_LOOP = 5, REGULAR = MESHES - 1 };

static bool is_near(const double x[3], const double y[3], double within)
{
    return fabs(x[0] - y[0]) <= within && fabs(x[1] - y[1]) <= within &&
           fabs(x[2] - y[2]) <= within;
}

/* Whether a point on a side of a piece is on a side of another; twelve points of each side. */
static bool is_shared(const instance *made, size_t but, const double x[3])
{
    for (size_t k = 0; k < piece_count(made); ++k)
        for (int n = 0; n < 4 * 16 && k != but; ++n) {
            const double at = n % 16 / 16., u[4] = {at, 1, at, 0}, v[4] = {0, at, 1, at};
            double y[3], error[3];
            point_of(made, k, u[n / 16], v[n / 16], y, error);
            if (is_near(x, y, 1e-13)) return true;
        }
    return false;
}

START_TEST(pieces_of_a_closed_mesh_share_their_sides)
{
    const int closed[] = {0, 1, CLOSED_LOOP, CLOSED_LOOP + 1};
    for (int n = 0; n < 4; ++n) {
        const int m = closed[n], sides = m < CLOSED_LOOP ? 4 : 3;
        instance made = made_of(meshes[m]);
        for (size_t k = 0; k < piece_count(&made); ++k)
            for (int side = 0; side < sides; ++side) {
                const double u[4] = {0.25, 1, 0.25, 0}, v[4] = {0, 0.25, 1, 0.25};
                double x[3], error[3];
                point_of(&made, k, u[side], v[side], x, error);
                ck_assert_msg(is_shared(&made, k, x), "mesh %d, piece %zu, side %d", m, k, side);
            }
        instance_free(&made);
    }
}
END_TEST

/* A region at the corner (0,0) or anywhere, of any size and shape. */
static imp_region any_region(uint64_t *random)
{
    double lo[3] = {0, 0, random_between(random, -1, 1)}, hi[3];
    hi[2] = lo[2] + random_between(random, 0, 1);
    for (int side = 0; side < 2; ++side) {
        const double size = ldexp(1, -(int)random_between(random, 0, 30));
        hi[side] = size * random_between(random, 0, 1);
        if (random_between(random, 0, 1) < 0.6) lo[side] = hi[side] * random_between(random, 0, 1);
        if (random_between(random, 0, 1) < 0.3) hi[side] = 1;
    }
    return region_make(lo, hi);
}

static void any_place(uint64_t *random, const imp_region *r, double p[3])
{
    for (int j = 0; j < 3; ++j) {
        const double share = random_between(random, -0.2, 1.2);
        p[j] = share <= 0   ? r->lo[j]
               : share >= 1 ? r->hi[j]
                            : r->lo[j] + share * (r->hi[j] - r->lo[j]);
        if (p[j] > r->hi[j]) p[j] = r->hi[j];
        if (j < 2 && random_between(random, 0, 1) < 0.3)
            p[j] = fmax(r->lo[j], p[j] * ldexp(1, -(int)random_between(random, 0, 40)));
    }
}

static double value_of(const imp_model *m, const double s[3])
{
    const double *q = m->q;
    return m->a + m->b[0] * s[0] + m->b[1] * s[1] + m->b[2] * s[2] + q[IMP_UU] * s[0] * s[0] +
           q[IMP_VV] * s[1] * s[1] + q[IMP_TT] * s[2] * s[2] + q[IMP_UV] * s[0] * s[1] +
           q[IMP_UT] * s[0] * s[2] + q[IMP_VT] * s[1] * s[2];
}

static void check_region(const instance *made, size_t k, const imp_region *r, uint64_t *random)
{
    imp_model model[3];
    double x[2][3], error[2][3], p[2][3], s[3];
    ck_assert_int_eq(made->surface->include(piece_of(made, k), r, model), IMP_STATUS_OK);
    for (int n = 0; n < 2; ++n) {
        any_place(random, r, p[n]);
        ck_assert_int_eq(made->surface->eval(piece_of(made, k), 1, p[n], x[n], error[n]),
                         IMP_STATUS_OK);
    }
    for (int j = 0; j < 3; ++j) s[j] = r->d[j] > 0 ? (p[0][j] - r->c[j]) / r->d[j] : 0;
    for (int i = 0; i < 3; ++i) {
        const imp_model *m = &model[i];
        const double slip = error[0][i] + 1e-14;
        double change = error[0][i] + error[1][i];
        for (int j = 0; j < 3; ++j) change += m->rate[j] * fabs(p[0][j] - p[1][j]);
        ck_assert_double_le(fabs(value_of(m, s) - x[0][i]), m->e + slip);
        ck_assert(x[0][i] >= m->lo - slip && x[0][i] <= m->hi + slip);
        ck_assert_double_le(fabs(x[0][i] - x[1][i]), change * (1 + 1e-9));
    }
}

START_TEST(bounds_hold_for_every_piece_at_every_scale)
{
    uint64_t random = suite_seed();
    for (int m = 0; m < MESHES; ++m) {
        instance made = made_of(meshes[m]);
        for (size_t k = 0; k < piece_count(&made); ++k)
            for (int n = 0; n < suite_times(60); ++n) {
                const imp_region r = any_region(&random);
                check_region(&made, k, &r, &random);
            }
        instance_free(&made);
    }
}
END_TEST

/* What bounds are must not depend on what was on the stack. */
static void soil_stack(void)
{
    volatile double filler[40000];
    for (size_t k = 0; k < sizeof filler / sizeof *filler; ++k) filler[k] = 1e30;
}

/* lambda is 0.41, 0.55 and 0.58 for 3, 5 and 6 faces, and 0.5 at a border; of Loop's up to
 * 0.625. */
START_TEST(bounds_shrink_toward_an_extraordinary_corner)
{
    for (int m = 0; m < REGULAR; ++m) {
        if (m == CLOSED_LOOP - 1)
            continue; /* two faces at each point: the first piece is regular */
        soil_stack();
        instance made = made_of(meshes[m]);
        double last = INFINITY, first = 0, e = 0;
        for (int level = 0; level < 40; ++level) {
            const double h = ldexp(1, -level);
            const imp_region r = region_make((double[3]){0, 0, 0}, (double[3]){h, h, 0});
            imp_model model[3];
            soil_stack();
            ck_assert_int_eq(made.surface->include(made.self, &r, model), IMP_STATUS_OK);
            e = fmax(model[0].e, fmax(model[1].e, model[2].e));
            if (level == 0) first = e;
            ck_assert_double_le(e, 0.75 * last + 1e-14);
            last = e;
        }
        ck_assert_double_le(e, 1e-8 * first);
        instance_free(&made);
    }
}
END_TEST

/* --- Contacts --------------------------------------------------------------------------------- */

#define CUBE_SURFACE "subdivision points=" CUBE_POINTS " faces=" CUBE_FACES

/* A point flies at the limit point (1,1,1) / 2 of a corner, and at (0, 0, 68 / 81). */
START_TEST(contact_at_an_extraordinary_point_comes_at_its_time)
{
    imp_result r = query_audited(CUBE_SURFACE, "point position=2,2,2 velocity=-2,-2,-2");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq_tol(r.t, 0.75, 1e-9);
    r = query_audited(CUBE_SURFACE, "point position=0,0,2 velocity=0,0,-2");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq_tol(r.t, 1 - 34. / 81, 1e-9);
}
END_TEST

/* Two cubes that move by their points' velocities meet in the middle, face to face. */
START_TEST(moving_control_points_move_the_surface)
{
    imp_result r = query_audited(
        CUBE_SURFACE
        " velocities=[[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0],[1,0,0]]",
        "point position=2,0,0 velocity=-1,0,0");
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
    ck_assert_double_eq_tol(r.t, 1 - 34. / 81, 1e-9);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        a_regular_grid_is_a_uniform_bicubic_spline,
        a_border_is_a_cubic_spline_that_ends_at_corners,
        a_cube_has_its_known_limit_points,
        a_plane_mesh_stays_in_its_plane,
        pieces_of_a_closed_mesh_share_their_sides,
        bounds_hold_for_every_piece_at_every_scale,
        bounds_shrink_toward_an_extraordinary_corner,
        contact_at_an_extraordinary_point_comes_at_its_time,
        moving_control_points_move_the_surface,
    };
    return suite_main_with("subdivision", tests, sizeof tests / sizeof *tests, open_registry,
                           close_registry);
}
