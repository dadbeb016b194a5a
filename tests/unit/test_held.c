/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#define IMPINGE_PLUGIN_SYMBOL spokes_plugin
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "core/scene/scene.h"
#include "core/surface/held.h"
#include "core/surface/region.h"
#include "tests/support/failing_query.h"

/* Surfaces that turn within themselves while they move at random are as far from others, and touch
 * them when, as if they did not turn; and where they touch is a point of theirs, at that time. */

enum { SCENES = 60, POINTS = 40, TEXT = 1200 };

/* --- A disc by diameters ---------------------------------------------------------------------- */

/* Closed, and points of one v are taken to each other by rotations, but they are half a circle: the
 * other half has the v of other sign. */
static void spokes_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 0.5 * IMP_TWO_PI_UPPER, -0.5, 0.5);
}

static void spokes_formula(const void *self, imp_model u, imp_model v, imp_model t,
                           imp_model out[3])
{
    imp_model sine, cosine;
    (void)self, (void)t;
    imp_sincos(u, &sine, &cosine);
    out[0] = imp_mul(v, cosine);
    out[1] = imp_mul(v, sine);
    out[2] = imp_num(0);
}
IMP_SURFACE_FORMULA(spokes_formula)

static imp_model spokes_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)self, (void)x, (void)y, (void)t;
    return z;
}
IMP_DISTANCE_FORMULA(spokes_gap)

static imp_status spokes_symmetry(const void *self, imp_symmetry *symmetry)
{
    (void)self;
    symmetry->kind = IMP_SYMMETRY_ABOUT_LINE;
    symmetry->is_closed = IMP_SYMMETRY_CLOSED | IMP_SYMMETRY_ORBIT_U;
    symmetry->axis[2] = 1;
    return IMP_STATUS_OK;
}

static imp_status spokes_create(const imp_value *values, void **self, imp_create_error *why)
{
    static int instance;
    (void)values, (void)why;
    *self = &instance;
    return IMP_STATUS_OK;
}

static void spokes_destroy(void *self) { (void)self; }

static const imp_surface_type spokes = {.struct_size = sizeof(imp_surface_type),
                                        .parameter_size = sizeof(imp_parameter),
                                        .name = "spokes",
                                        .summary = "a disc",
                                        .equation = "(v cos u, v sin u, 0)",
                                        .example = "spokes",
                                        .create = spokes_create,
                                        .destroy = spokes_destroy,
                                        .domain = spokes_domain,
                                        .eval = spokes_formula_eval,
                                        .rate = spokes_formula_rate,
                                        .include = spokes_formula_include,
                                        .distance = spokes_gap_distance,
                                        .symmetry = spokes_symmetry};
IMPINGE_SURFACE_PLUGIN("spokes", "1.0", "Apache-2.0", "The Impinge authors", spokes);

static imp_registry *registry;

static void open_registry(void)
{
    imp_error error;
    registry = query_registry();
    const imp_code code = imp_registry_add(registry, &spokes_plugin, &error);
    ck_assert_msg(code == IMP_SUCCESS, "%s", error.text);
}

static void close_registry(void) { imp_registry_free(registry); }

/* --- Scenes ----------------------------------------------------------------------------------- */

/* A cylinder of four rational arcs about z. */
#define CYLINDER_OF_ARCS                                                                           \
    "nurbs degree=2,1 knots_u=[0,0,0,1,1,2,2,3,3,4,4,4] knots_v=[0,0,1,1] points=[[0.3,0,-0.5"     \
    "],[0.3,0,0.4],[0.3,0.3,-0.5],[0.3,0.3,0.4],[0,0.3,-0.5],[0,0.3,0.4],[-0.3,0.3,-0.5],[-0."     \
    "3,0.3,0.4],[-0.3,0,-0.5],[-0.3,0,0.4],[-0.3,-0.3,-0.5],[-0.3,-0.3,0.4],[0,-0.3,-0.5],[0,"     \
    "-0.3,0.4],[0.3,-0.3,-0.5],[0.3,-0.3,0.4],[0.3,0,-0.5],[0.3,0,0.4]] weights=[1,1,0.707106"     \
    "78118654757,0.70710678118654757,1,1,0.70710678118654757,0.70710678118654757,1,1,0.707106"     \
    "78118654757,0.70710678118654757,1,1,0.70710678118654757,0.70710678118654757,1,1]"

/* Closed about z, some in pieces, some but for rounding. */
static const char *const rounds[] = {"cylinder radius=0.4 height=0.8 ends=true",
                                     "cylinder radius=0.3 height=0.5",
                                     "cone ends=true",
                                     "cone",
                                     "torus major_radius=0.5 minor_radius=0.2",
                                     "disc radius=0.5",
                                     "capsule radius=0.3 from=0,0,-0.4 to=0,0,0.4",
                                     "ellipsoid radii=0.5,0.5,0.3",
                                     CYLINDER_OF_ARCS};
static const char *const others[] = {"box size=1,0.8,0.6",
                                     "plane origin=-2,-2,0 edge_u=4,0,0 edge_v=0,4,0",
                                     "sphere radius=0.4",
                                     "ellipsoid radii=0.6,0.4,0.3",
                                     "torus major_radius=0.6 minor_radius=0.2",
                                     "cylinder radius=0.3 height=1 ends=true"};

static void add_spin(uint64_t *random, char *text)
{
    text_add(text, TEXT, " ! rotate axis=0,0,%.17g rate=%.17g",
             random_bits(random) % 2 ? 1.0 : -2.0,
             random_power(random, -1, 5) * random_part(random));
}

static void add_motion(uint64_t *random, double far, char *text)
{
    if (random_bits(random) % 2)
        text_add(text, TEXT, " ! rotate axis=%.17g,%.17g,%.17g angle=%.17g,%.17g",
                 random_part(random), random_part(random), random_part(random),
                 3 * random_part(random), random_bits(random) % 2 ? random_part(random) : 0.0);
    text_add(text, TEXT, " ! translate offset=[[%.17g,%.17g,%.17g],[%.17g,%.17g,%.17g]]",
             far * random_part(random), far * random_part(random), far, random_part(random),
             random_part(random), -far * random_fraction(random));
}

/* One scene twice: the first with what only turns within itself, at any place among its maps that
 * does not show. */
typedef struct twins {
    char a[2][3 * TEXT], b[2][3 * TEXT];
} twins;

static twins draw_twins(uint64_t *random)
{
    twins y;
    char motion[2][TEXT] = {"", ""}, spin[2][TEXT] = {"", ""};
    const char *const a = rounds[random_bits(random) % (sizeof rounds / sizeof *rounds)];
    const size_t shapes = sizeof others / sizeof *others, k = random_bits(random) % shapes;
    add_spin(random, spin[0]);
    if (k >= shapes - 2) add_spin(random, spin[1]); /* the last two are round, too */
    add_motion(random, 1.5, motion[0]);
    if (random_bits(random) % 2) add_motion(random, 0.1, motion[1]);
    for (int j = 0; j < 2; ++j) {
        snprintf(y.a[j], sizeof y.a[j], "%s%s%s", a, j == 0 ? spin[0] : "", motion[0]);
        snprintf(y.b[j], sizeof y.b[j], "%s%s%s", others[k], j == 0 ? spin[1] : "", motion[1]);
    }
    return y;
}

/* --- Answers ---------------------------------------------------------------------------------- */

/* The point is where its parameters are. */
static void check_side(const imp_scene *scene, const imp_side *side, double t)
{
    const imp_place at = {side->body, side->surface, side->piece};
    const double p[3] = {side->u, side->v, t};
    double x[3], inexact[3];
    ck_assert_int_eq(imp_piece_eval(scene, at, 1, p, x, inexact, NULL), IMP_SUCCESS);
    ck_assert_double_eq(query_distance(x, side->point), 0);
}

static imp_result touch(const char *a, const char *b, double gamma)
{
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s | %s: %s", a, b, error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = gamma;
    options.max_pairs = 20000;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s | %s: %s", a, b,
                  error.text);
    if (r.verdict == IMP_VERDICT_CONTACT) {
        check_side(scene, &r.a, r.t);
        check_side(scene, &r.b, r.t);
    }
    if (r.verdict == IMP_VERDICT_CONTACT)
        ck_assert_msg(query_distance(r.a.point, r.b.point) <= gamma * (1 + 1e-9), "%s | %s: %g", a,
                      b, query_distance(r.a.point, r.b.point));
    imp_scene_free(scene);
    return r;
}

static imp_clearance measured(const char *a, const char *b)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-7;
    options.max_pairs = 20000;
    const imp_clearance_options asked = imp_clearance_options_default();
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_msg(imp_query_step(query, 0, &error) == IMP_SUCCESS, "%s | %s: %s", a, b, error.text);
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    ck_assert_int_eq(imp_clearance_get(query, 0, &answer, NULL), IMP_SUCCESS);
    if (answer.has_witness) {
        check_side(scene, &answer.a, answer.t);
        check_side(scene, &answer.b, answer.t);
        ck_assert_double_le(query_distance(answer.a.point, answer.b.point),
                            answer.upper * (1 + 1e-12));
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return answer;
}

START_TEST(what_turns_within_itself_touches_when_it_would_at_rest)
{
    uint64_t random = suite_seed();
    int touches = 0, clear = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const twins y = draw_twins(&random);
        const double gamma = random_power(&random, -20, -8);
        const imp_clearance apart = measured(y.a[1], y.b[1]);
        const imp_result r = touch(y.a[0], y.b[0], gamma), s = touch(y.a[1], y.b[1], gamma);
        touches += r.verdict == IMP_VERDICT_CONTACT;
        clear += r.verdict == IMP_VERDICT_CLEAR;
        if (r.verdict == IMP_VERDICT_CONTACT)
            ck_assert_msg(apart.lower <= gamma, "%s | %s", y.a[0], y.b[0]);
        if (r.verdict == IMP_VERDICT_CLEAR)
            ck_assert_msg(apart.upper >= 0.5 * gamma, "%s | %s", y.a[0], y.b[0]);
        if (r.verdict == IMP_VERDICT_UNDECIDED || s.verdict != IMP_VERDICT_CONTACT) continue;
        /* Nothing is nearer than gamma / 2 before t_lower; nor is what is known at rest. */
        const imp_result first = touch(y.a[1], y.b[1], 0.5 * gamma);
        if (first.verdict == IMP_VERDICT_CONTACT)
            ck_assert_msg(r.t_lower <= first.t, "%s | %s: %.17g, %.17g", y.a[0], y.b[0], r.t_lower,
                          first.t);
    }
    ck_assert_msg(touches > 5 && clear > 5, "%d touch, %d are clear", touches, clear);
}
END_TEST

START_TEST(what_turns_within_itself_is_as_far_as_it_would_be_at_rest)
{
    uint64_t random = suite_seed();
    int apart = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const twins y = draw_twins(&random);
        imp_clearance r[2];
        for (int j = 0; j < 2; ++j) r[j] = measured(y.a[j], y.b[j]);
        ck_assert_msg(r[0].lower <= r[1].upper + 1e-12 && r[1].lower <= r[0].upper + 1e-12,
                      "%s | %s: [%.17g, %.17g], at rest [%.17g, %.17g]", y.a[0], y.b[0], r[0].lower,
                      r[0].upper, r[1].lower, r[1].upper);
        apart += r[0].lower > 0;
    }
    ck_assert_msg(apart > 5, "%d are apart", apart);
}
END_TEST

/* --- Slices of time --------------------------------------------------------------------------- */

enum { SLICES = 4 };

/* Returns the query that measures a and b in slices, ended. */
static imp_query *sliced(imp_scene *scene, uint64_t slices)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_options options = imp_options_default(scene);
    options.gamma = 1e-7;
    options.max_pairs = 20000 * slices;
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = slices;
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_msg(imp_query_step(query, 0, &error) == IMP_SUCCESS, "%s", error.text);
    return query;
}

static imp_clearance slice_of(const imp_scene *scene, const imp_query *query, size_t k)
{
    imp_clearance r = {.struct_size = (uint32_t)sizeof r};
    ck_assert_int_eq(imp_clearance_get(query, k, &r, NULL), IMP_SUCCESS);
    if (r.has_witness) {
        ck_assert(r.t_start <= r.t && r.t <= r.t_end);
        check_side(scene, &r.a, r.t);
        check_side(scene, &r.b, r.t);
        ck_assert_double_le(query_distance(r.a.point, r.b.point), r.upper * (1 + 1e-12));
    }
    return r;
}

START_TEST(what_turns_within_itself_is_in_each_slice_as_far_as_at_rest)
{
    uint64_t random = suite_seed();
    int apart = 0, differ = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const twins y = draw_twins(&random);
        imp_scene *scene[2];
        imp_query *query[2];
        imp_error error;
        for (int j = 0; j < 2; ++j) {
            scene[j] = imp_scene_from_pair(registry, y.a[j], y.b[j], &error);
            ck_assert_msg(scene[j] != NULL, "%s", error.text);
            query[j] = sliced(scene[j], SLICES);
        }
        double least = INFINITY, most = 0;
        for (size_t k = 0; k < SLICES; ++k) {
            const imp_clearance r = slice_of(scene[0], query[0], k),
                                s = slice_of(scene[1], query[1], k);
            ck_assert_msg(r.lower <= s.upper + 1e-12 && s.lower <= r.upper + 1e-12,
                          "%s | %s, slice %zu: [%.17g, %.17g], at rest [%.17g, %.17g]", y.a[0],
                          y.b[0], k, r.lower, r.upper, s.lower, s.upper);
            apart += r.lower > 0;
            least = r.upper < least ? r.upper : least;
            most = r.lower > most ? r.lower : most;
        }
        differ += least < most;
        for (int j = 0; j < 2; ++j) imp_query_free(query[j]), imp_scene_free(scene[j]);
    }
    ck_assert_msg(apart > 20 && differ > 5, "%d are apart, %d differ", apart, differ);
}
END_TEST

/* What turns within itself needs few pairs a slice, however many slices there are, and trees that
 * are made anew for later slices hold what the first ones held. */
START_TEST(slices_of_what_turns_within_itself_cost_little)
{
    static const struct {
        const char *a, *b;
        uint64_t slices, pairs_of_one;
        double apart;
    } row[] = {
        {"cylinder radius=0.4 ends=true ! rotate axis=0,0,1 rate=100",
         "box size=1,1,1 center=0.901,0,0.02", 4, 60, 0.001},
        {"capsule radius=0.3 ! rotate axis=0,0,1 rate=20 ! translate velocity=0,0.3,0",
         "box size=0.5,1,2 center=0.551,0.1,0.2", 4, 60, 0.001},
        {"torus ! rotate axis=0,0,1 rate=20 ! rotate axis=1,0,0 angle=[0.3] ! translate "
         "velocity=0,0,0.1",
         "sphere radius=0.5 center=4,0.3,0.1", 3000, 50, NAN},
        {"torus ! rotate axis=0,0,1 rate=20",
         "torus minor_radius=0.2 ! rotate axis=0,0,1 "
         "rate=-3 ! translate velocity=0,0,0.1",
         1000, 20, NAN},
        /* What rests at one moment of each slice: */
        {"cylinder radius=0.4 height=0.5 ! rotate axis=0,0,1 rate=20 ! translate "
         "offset=[[0.099,0,0]] ! rotate axis=0,0,1 rate=3",
         "cylinder radius=0.5 height=2", 300, 50, 0.001},
        {"disc radius=0.5 ! rotate axis=0,0,1 rate=189 ! translate offset=[[-1.3,-0.9,1.5]]",
         "box size=1,0.8,0.6", 300, 100, NAN},
        /* The planes of a box are tried in each slice: */
        {"disc radius=1 ! rotate axis=0,0,1 rate=7", "box size=1,1,1 center=1.6,0,0", 100, 8, 0.1}};
    for (size_t n = 0; n < sizeof row / sizeof *row; ++n) {
        imp_error error;
        imp_scene *scene = imp_scene_from_pair(registry, row[n].a, row[n].b, &error);
        ck_assert_msg(scene != NULL, "%s", error.text);
        imp_query *query = sliced(scene, row[n].slices);
        uint64_t pairs = 0;
        for (uint64_t k = 0; k < row[n].slices; ++k) {
            const imp_clearance r = slice_of(scene, query, k);
            ck_assert_msg(r.reason == IMP_REASON_NONE, "%s | %s, slice %d: reason %d", row[n].a,
                          row[n].b, (int)k, (int)r.reason);
            if (!isnan(row[n].apart))
                ck_assert(r.lower <= row[n].apart && row[n].apart <= r.upper * (1 + 1e-9));
            pairs += r.stats.pairs;
        }
        ck_assert_msg(pairs <= row[n].slices * row[n].pairs_of_one, "%s | %s: %d pairs", row[n].a,
                      row[n].b, (int)pairs);
        imp_query_free(query);
        imp_scene_free(scene);
    }
}
END_TEST

/* --- Points ----------------------------------------------------------------------------------- */

/* Points of the surface held, at any time, are points of the surface. */
START_TEST(each_point_of_a_surface_held_is_one_of_the_surface)
{
    uint64_t random = suite_seed();
    int turns = 0;
    for (int n = 0; n < suite_times_at_least(SCENES); ++n) {
        const twins y = draw_twins(&random);
        imp_error error;
        imp_scene *scene = imp_scene_from_pair(registry, y.a[0], y.b[0], &error);
        ck_assert_msg(scene != NULL, "%s", error.text);
        const surface *s = scene_surface(scene, 0, 0);
        const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){0, 0, 1});
        imp_model bare[3];
        held_maps held;
        for (int i = 0; i < 3; ++i) bare[i] = imp_between(-2, 2);
        ck_assert_int_eq(surface_held_maps(s, bare, &times, 1e-9, &held), IMP_STATUS_OK);
        ck_assert_uint_le(held.count, 1);
        turns += (int)held.count;
        surface *still = surface_new_held(s, surface_map_count(s), held);
        ck_assert_ptr_nonnull(still);
        for (int k = 0; k < POINTS && held.count > 0; ++k) {
            const size_t piece = random_bits(&random) % surface_part_count(s);
            const double t = random_fraction(&random);
            double lo[3], hi[3], p[3], x[3], found[3];
            surface_domain(surface_part(s, piece), lo, hi);
            for (int j = 0; j < 2; ++j) p[j] = lo[j] + random_fraction(&random) * (hi[j] - lo[j]);
            p[2] = t;
            ck_assert_int_eq(surface_eval(surface_part(still, piece), 1, p, x, NULL),
                             IMP_STATUS_OK);
            ck_assert_int_eq(surface_held_place(surface_part(s, piece), held, surface_map_count(s),
                                                t, x, &p[0], &p[1]),
                             IMP_STATUS_OK);
            ck_assert_int_eq(surface_eval(surface_part(s, piece), 1, p, found, NULL),
                             IMP_STATUS_OK);
            ck_assert_msg(query_distance(x, found) <= 1e-13, "%s at %.17g: %g", y.a[0], t,
                          query_distance(x, found));
        }
        surface_free(still);
        imp_scene_free(scene);
    }
    ck_assert_int_gt(4 * turns, 3 * SCENES);
}
END_TEST

/* A turn beside the line, one by a little less than a rotation of it, one of a box, and one of what
 * has no whole circles are not held. */
START_TEST(what_turns_beside_its_line_is_not_held)
{
    static const char *const moving[] = {
        "cylinder ends=true ! rotate axis=0,0,1 center=1e-9,0,0 rate=2",
        "cylinder ! rotate axis=0,1e-9,1 rate=2",
        "torus ! rotate axis=1,0,0 rate=2",
        "box ! rotate axis=0,0,1 rate=2",
        "capsule ! rotate axis=1,0,0 rate=2",
        "capsule ! rotate axis=0,0,1 center=1e-9,0,0 rate=2",
        "capsule to=0.25,0.5,1 ! rotate axis=0.25,0.5,1.0000001 rate=2",
        "spokes ! rotate axis=0,0,1 rate=2",
        "cone ! translate velocity=0,0,1",
        "cylinder ! scale factor=[2,2,2] ! rotate axis=0,0,1 rate=2"};
    for (size_t n = 0; n < sizeof moving / sizeof *moving; ++n) {
        imp_error error;
        imp_scene *scene = imp_scene_from_pair(registry, moving[n], "sphere", &error);
        ck_assert_msg(scene != NULL, "%s", error.text);
        const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){0, 0, 1});
        imp_model bare[3];
        held_maps held;
        for (int i = 0; i < 3; ++i) bare[i] = imp_between(-2, 2);
        ck_assert_int_eq(surface_held_maps(scene_surface(scene, 0, 0), bare, &times, 1e-12, &held),
                         IMP_STATUS_OK);
        ck_assert_msg(held.count == 0, "%s", moving[n]);
        imp_scene_free(scene);
    }
}
END_TEST

/* A tube that an angle of u goes around, perhaps faster at one end, more than once, or back. */
#define TURNED_BY(ANGLE)                                                                           \
    {                                                                                              \
        "formula x=0.5*cos(" ANGLE ") y=0.5*sin(" ANGLE ") z=v domain=[[0,1],[-1,1]] ! "           \
        "rotate axis=0,0,1 rate=5 ! translate offset=[[2,-0.2,0],[-2,0,0]]",                       \
            "sphere radius=0.3", 1e-6                                                              \
    }

/* The reported points are within the reported gap far from the origin, at the origin, where the
 * first maps shift the line by less than the slip that a search permits, and where parameters run
 * around unevenly. */
START_TEST(points_of_surfaces_held_are_found_wherever_they_are)
{
    static const struct {
        const char *a, *b;
        double gamma;
    } row[] = {
        {"torus major_radius=0.5 minor_radius=0.2 ! rotate axis=0,0,1 rate=6 ! translate "
         "offset=[[100000000003,100000000000.02,1e11],[-3,0,0]]",
         "sphere radius=0.3 center=1e11,1e11,100000000000.01", 0.003},
        {"torus major_radius=0.5 minor_radius=0.2 ! rotate axis=0,0,1 rate=6 ! rotate axis=1,0,0 "
         "angle=1.5707963267948966 ! translate offset=[[0,0,2],[0,0,-2.6]]",
         "sphere radius=0.3 center=0,0,-0.3", 1e-8},
        {"cylinder radius=0.5 height=1 ! rotate axis=0,0,1 center=1e-8,0,0 rate=30 ! translate "
         "offset=[[2,0.1,0],[-2,0,0]]",
         "sphere radius=0.3", 1e-3},
        {"cylinder radius=0.5 height=1 ! rotate axis=1e-8,0,1 rate=30 ! translate "
         "offset=[[2,0.1,0],[-2,0,0]]",
         "sphere radius=0.3", 1e-2},
        {"capsule radius=0.3 from=1,1,1 to=1.25,1.5,2 ! rotate axis=0.25,0.5,1 center=1,1,1 "
         "rate=20 "
         "! translate velocity=-1.5,-1,-0.5",
         "sphere radius=0.3 center=0,0.6,0.9", 1e-8},
        {"spokes ! rotate axis=0,0,1 rate=5 ! translate offset=[[3,-0.1,0.1],[-3,0,0]]",
         "sphere radius=0.3", 1e-6},
        TURNED_BY("10*u"),
        TURNED_BY("300*u^3"),
        TURNED_BY("7*tanh(25*u)"),
        TURNED_BY("6*u+3*sin(3*u)")};
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        const imp_result r = touch(row[k].a, row[k].b, row[k].gamma);
        ck_assert_int_eq(r.verdict, IMP_VERDICT_CONTACT);
        ck_assert_double_le(query_distance(r.a.point, r.b.point), r.gap * (1 + 1e-9));
    }
}
END_TEST

/* --- Memory ----------------------------------------------------------------------------------- */

START_TEST(a_query_that_holds_maps_and_runs_out_of_memory_can_go_on)
{
    const failing_query q = {.registry = registry,
                             .a = "cylinder ends=true ! rotate axis=0,0,1 rate=5 ! translate "
                                  "velocity=-2,0,0",
                             .b = "sphere radius=0.5 center=-2,0,0",
                             .verdict = IMP_VERDICT_CONTACT,
                             .pairs_most = UINT64_MAX};
    failing_query_try_all(&q);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {what_turns_within_itself_touches_when_it_would_at_rest,
                                  what_turns_within_itself_is_as_far_as_it_would_be_at_rest,
                                  what_turns_within_itself_is_in_each_slice_as_far_as_at_rest,
                                  slices_of_what_turns_within_itself_cost_little,
                                  each_point_of_a_surface_held_is_one_of_the_surface,
                                  what_turns_beside_its_line_is_not_held,
                                  points_of_surfaces_held_are_found_wherever_they_are,
                                  a_query_that_holds_maps_and_runs_out_of_memory_can_go_on};
    return suite_main_with("held", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
