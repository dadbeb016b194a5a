/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/half_plane.h"

#include "tests/support/alloc_failure.h"
#include "tests/support/query_helpers.h"
#include "tests/support/slip_helpers.h"

/* One half plane stands for all where two surfaces are closed about one line. */

/* --- Companions of points --------------------------------------------------------------------- */

typedef struct side {
    imp_symmetry of;
    motion map[4];
    size_t count;
} side;

static long double dot(const double k[3], const long double x[3])
{
    return k[0] * x[0] + k[1] * x[1] + k[2] * x[2];
}

static long double between(const long double x[3], const long double y[3])
{
    return hypotl(hypotl(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
}

/* Where a bare point of the side is at t. */
static void place(const side *s, const long double bare[3], double t, long double x[3])
{
    memcpy(x, bare, 3 * sizeof *x);
    for (size_t k = 0; k < s->count; ++k) apply(&s->map[k], t, x);
}

/* Points of a circle: the turns of x about the line through c along the unit vector n. */
typedef struct circle {
    long double middle[3], a[3], b[3]; /* middle + cos a + sin b */
} circle;

static circle circle_of(const long double x[3], const long double c[3], const long double n[3])
{
    circle made;
    long double along = 0;
    for (int i = 0; i < 3; ++i) along += (x[i] - c[i]) * n[i];
    for (int i = 0; i < 3; ++i) {
        made.middle[i] = c[i] + along * n[i];
        made.a[i] = x[i] - made.middle[i];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        made.b[i] = n[j] * made.a[k] - n[k] * made.a[j];
    }
    return made;
}

/* Line of a side's rotations at t: of a ball, the one along the other's line. */
static circle turns_of(const side s[2], int k, const long double x[3], double t)
{
    const side *line = s[k].of.kind == IMP_SYMMETRY_ABOUT_LINE ? &s[k] : &s[!k];
    long double foot[3], end[3], c[3], bare[3];
    for (int i = 0; i < 3; ++i) bare[i] = line->of.center[i];
    place(line, bare, t, foot);
    bare[2] += 1;
    place(line, bare, t, end);
    for (int i = 0; i < 3; ++i) end[i] -= foot[i];
    for (int i = 0; i < 3; ++i) bare[i] = s[k].of.center[i];
    place(&s[k], bare, t, c);
    return circle_of(x, c, end);
}

/* The point of the circle that is farthest along a direction. */
static void farthest(const circle *of, const long double e[3], long double x[3])
{
    long double a = 0, b = 0;
    for (int i = 0; i < 3; ++i) a += e[i] * of->a[i], b += e[i] * of->b[i];
    const long double angle = atan2l(b, a);
    for (int i = 0; i < 3; ++i)
        x[i] = of->middle[i] + cosl(angle) * of->a[i] + sinl(angle) * of->b[i];
}

static bool is_held(const half_plane *h, const long double x[3])
{
    const long double across = dot(h->across, x), rounding = 1e-17L;
    return across >= h->across_lo - rounding && across <= h->across_hi + rounding &&
           dot(h->along, x) >= h->along_lo - rounding;
}

/* The least distance of companions that are tried: that of the line's side in the half plane
 * itself, that of the other side there, or as near as it comes. INFINITY: none are held. */
static long double least_apart(const circle of[2], const half_plane h[2], int line)
{
    long double e[3], x[3], y[3], least = INFINITY;
    for (int i = 0; i < 3; ++i) e[i] = h[line].along[i];
    farthest(&of[line], e, x);
    if (!is_held(&h[line], x)) return INFINITY;
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 3 && k == 1; ++i) e[i] = x[i] - of[!line].middle[i];
        farthest(&of[!line], e, y);
        const long double d = between(x, y);
        if (is_held(&h[!line], y) && d < least) least = d;
    }
    return least;
}

/* --- The lemma -------------------------------------------------------------------------------- */

static void draw_map(uint64_t *random, const double center[3], motion *m)
{
    *m = (motion){.rate = 0};
    switch (random_bits(random) % 3) {
    case 0:
        *m = spin_about(center, random_between(random, -3, 3));
        break;
    case 1:
        draw_vector(random, 2, m->way);
        break;
    default:
        m->place[0][1] = m->place[1][2] = m->place[2][0] = 1;
        m->is_placed = true;
    }
}

static surface *surface_of(side *s)
{
    surface *made = surface_new(&target, &s->of);
    ck_assert_ptr_nonnull(made);
    for (size_t k = 0; k < s->count; ++k)
        ck_assert_int_eq(surface_add_map(made, &exactly, &s->map[k]), IMP_SUCCESS);
    return made;
}

/* Two surfaces under the same maps, which carry both lines alike; the second turns about its own
 * line before, and that is aside, or tilted, by as much as comes out. */
static void draw_sides(uint64_t *random, side s[2])
{
    const double aside = random_bits(random) % 4 ? random_power(random, -40, -2) : 0;
    for (int k = 0; k < 2; ++k) {
        s[k] = (side){.of = {.kind = IMP_SYMMETRY_ABOUT_LINE, .is_closed = IMP_SYMMETRY_CLOSED}};
        s[k].of.axis[2] = random_power(random, -4, 4) * (random_bits(random) % 2 ? 1 : -1);
    }
    draw_vector(random, 1, s[0].of.center);
    for (int i = 0; i < 3; ++i)
        s[1].of.center[i] = s[0].of.center[i] + (i < 2 ? aside * random_between(random, -1, 1) : 1);
    if (random_bits(random) % 4 == 0) s[random_bits(random) % 2].of.kind = IMP_SYMMETRY_ABOUT_POINT;
    s[1].map[0] = spin_about(s[1].of.center, 2);
    s[1].count = 1;
    if (random_bits(random) % 2) {
        s[1].map[0] = (motion){.is_placed = true};
        const double tilt = random_power(random, -40, -4), c = sqrt(1 - tilt * tilt);
        const double turn[3][3] = {{c, 0, tilt}, {0, 1, 0}, {-tilt, 0, c}};
        memcpy(s[1].map[0].place, turn, sizeof turn);
    }
    const size_t maps = random_bits(random) % 3;
    for (size_t k = 0; k < maps; ++k) {
        draw_map(random, s[0].of.center, &s[0].map[k]);
        s[1].map[s[1].count++] = s[0].map[k];
    }
    s[0].count = maps;
}

static void try_pair(uint64_t *random, double part_of_slip, tally *of)
{
    side s[2];
    half_plane h[2];
    double slip;
    int asked;
    draw_sides(random, s);
    const double from = random_between(random, -1, 1), lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9};
    const imp_region times = region_make(
        (double[3]){0, 0, from},
        (double[3]){1, 1, from + (random_bits(random) % 2 ? random_power(random, -6, -1) : 0)});
    surface *made[2] = {surface_of(&s[0]), surface_of(&s[1])};
    const surface *const both[2] = {made[0], made[1]};
    const half_plane_boxes boxes = {{lo, lo}, {hi, hi}};
    ck_assert_int_eq(surface_half_plane(both, &boxes, &times, h, &slip, &asked), IMP_STATUS_OK);
    of->known += slip < INFINITY;
    of->exact += slip < 0x1p-40;
    for (int k = 0; k < POINTS && slip < INFINITY; ++k) {
        const double t = random_between(random, times.lo[2], times.hi[2]);
        long double bare[2][3], x[2][3];
        for (int i = 0; i < 3; ++i) bare[0][i] = s[0].of.center[i] + random_between(random, -2, 2);
        for (int i = 0; i < 3; ++i)
            bare[1][i] = bare[0][i] + random_power(random, -20, 1) * random_between(random, -1, 1);
        for (int j = 0; j < 2; ++j) place(&s[j], bare[j], t, x[j]);
        const circle of_both[2] = {turns_of(s, 0, x[0], t), turns_of(s, 1, x[1], t)};
        const long double was = between(x[0], x[1]),
                          least = least_apart(of_both, h,
                                              s[0].of.kind == IMP_SYMMETRY_ABOUT_LINE ? 0 : 1);
        of->judged += 1;
        of->refuted += least > was + part_of_slip * (long double)slip + 0x1p-46L;
    }
    surface_free(made[0]);
    surface_free(made[1]);
}

START_TEST(points_of_one_half_plane_are_as_near)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 2); ++k) try_pair(&random, 1, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(3 * of.known > suite_times(CASES / 2), "%d are known", of.known);
    ck_assert_msg(20 * of.exact > suite_times(CASES / 2), "%d are exact", of.exact);
    for (int k = 0; k < suite_times(CASES / 2); ++k) try_pair(&random, -1, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

/* The slip of two surfaces about one line, at rest, in boxes of 18 each way. */
static double slip_at_rest(uint32_t first, uint32_t second)
{
    const double lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9};
    const half_plane_boxes boxes = {{lo, lo}, {hi, hi}};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1});
    side s[2];
    half_plane h[2];
    double slip;
    int asked;
    for (int k = 0; k < 2; ++k)
        s[k] = (side){.of = {.kind = IMP_SYMMETRY_ABOUT_LINE, .axis = {0, 0, 1}}};
    s[0].of.is_closed = first;
    s[1].of.is_closed = second;
    surface *made[2] = {surface_of(&s[0]), surface_of(&s[1])};
    const surface *const both[2] = {made[0], made[1]};
    ck_assert_int_eq(surface_half_plane(both, &boxes, &times, h, &slip, &asked), IMP_STATUS_OK);
    surface_free(made[0]);
    surface_free(made[1]);
    return slip;
}

START_TEST(what_is_closed_but_for_a_slack_slips_by_it)
{
    const uint32_t closed = IMP_SYMMETRY_CLOSED, loose = closed | IMP_SYMMETRY_NEARLY;
    const double exact = slip_at_rest(closed, closed);
    const double slack = IMP_NEARLY_SLACK * 31.17; /* 18 3^(1/2): the diagonal of a box */
    ck_assert_double_lt(exact, 1e-12);
    ck_assert_double_ge(slip_at_rest(closed, loose), exact + slack);
    ck_assert_double_ge(slip_at_rest(loose, closed), exact + slack);
    ck_assert_double_ge(slip_at_rest(loose, loose), exact + 2 * slack);
    ck_assert_double_lt(slip_at_rest(loose, loose), exact + 2.002 * slack);
}
END_TEST

/* --- Answers ---------------------------------------------------------------------------------- */

typedef struct coaxial {
    const char *a, *b;
    double gamma, t; /* of the contact; < 0: none */
    double distance; /* the least, if there is no contact */
    uint64_t pairs, clearance_pairs;
} coaxial;

static const coaxial coaxials[] = {
    {"ellipsoid radii=1.5,1,1", "ellipsoid radii=1.499,0.999,0.999 ! rotate axis=1,0,0 rate=2",
     1e-4, -1, 9.7978e-4, 120, 400},
    {"ellipsoid radii=1,1.5,1 center=-5,3,-1", "ellipsoid radii=0.999,1.499,0.999 center=-5,3,-1",
     1e-4, -1, 9.7978e-4, 200, 800},
    {"torus major_radius=2 minor_radius=.5",
     "torus major_radius=2.6 minor_radius=.5 ! translate offset=[[0,0,1.8],[0,0,-1]]", 1e-6, 1, 0,
     250, 0},
    {"torus major_radius=2 minor_radius=.5 center=5,3,1",
     "torus major_radius=2.6 minor_radius=.5 center=5,3,1 ! translate offset=[[0,0,1.8],[0,0,-1]]",
     1e-6, 1, 0, 250, 0},
    {"ellipsoid radii=2,2,1", "sphere radius=0.5 ! translate offset=[[0,0,3],[0,0,-1.5]]", 1e-6, 1,
     0, 5000, 0},
};
enum { COAXIALS = sizeof coaxials / sizeof *coaxials };

START_TEST(coaxial_surfaces_meet_when_they_do)
{
    const coaxial *x = &coaxials[_i];
    imp_error error;
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_pair(registry, x->a, x->b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = x->gamma;
    options.t_start = 0, options.t_end = 2;
    options.max_pairs = 100000;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    query_check(scene, &options, &r);
    ck_assert_int_eq(r.verdict, x->t < 0 ? IMP_VERDICT_CLEAR : IMP_VERDICT_CONTACT);
    ck_assert_msg(r.stats.pairs <= x->pairs, "%llu pairs", (unsigned long long)r.stats.pairs);
    if (x->t >= 0) {
        ck_assert_double_le(r.t, x->t);
        ck_assert_double_ge(r.t, x->t - 4 * x->gamma);
    } else {
        query_brackets(scene, &options, NULL, x->distance, 1e-4, x->clearance_pairs);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* A clearance of each pair, in which an allocation fails, leaves nothing and goes on. */
static bool answer_failing_at(imp_registry *registry, size_t n)
{
    const coaxial *x = &coaxials[0];
    imp_error error;
    imp_scene *scene = imp_scene_from_pair(registry, x->a, x->b, &error);
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance found = {.struct_size = sizeof found};
    options.gamma = x->gamma;
    asked.each = n % 2 == 0;
    asked.required = n % 3 == 0 ? 9e-4 : 0;
    imp_code code = IMP_SUCCESS;
    alloc_failure_begin(n);
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    if (query != NULL) code = imp_query_step(query, 0, &error);
    const bool failed = alloc_failure_end();
    ck_assert(code == IMP_SUCCESS && (query != NULL || error.code == IMP_ERROR_MEMORY));
    if (query != NULL) {
        ck_assert_int_eq(imp_query_step(query, 0, &error), IMP_SUCCESS);
        ck_assert_int_eq(imp_clearance_get(query, 0, &found, &error), IMP_SUCCESS);
        ck_assert(found.lower <= x->distance && found.upper >= x->distance * (1 - 1e-4));
        ck_assert_uint_le(found.stats.pairs, x->clearance_pairs);
    }
    imp_query_free(query);
    imp_scene_free(scene);
    return failed;
}

/* Each time with a registry of its own, whose store has no blocks yet. */
START_TEST(nothing_is_left_where_memory_ends)
{
    size_t n = 0, answered = 0, before = 0;
    for (; n < 10000 && answered < 6; ++n) {
        imp_registry *registry = query_registry();
        answered = answer_failing_at(registry, n + 1) ? 0 : answered + 1;
        imp_registry_free(registry);
        if (n == 0) before = alloc_failure_live(); /* all is loaded */
        ck_assert_msg(alloc_failure_live() == before, "failing allocation %zu leaves %zd blocks",
                      n + 1, (ssize_t)(alloc_failure_live() - before));
    }
    ck_assert_uint_gt(n, 30);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {{points_of_one_half_plane_are_as_near, 1},
                                {what_is_closed_but_for_a_slack_slips_by_it, 1},
                                {coaxial_surfaces_meet_when_they_do, COAXIALS},
                                {nothing_is_left_where_memory_ends, 1}};
    return suite_main_loops("half planes", loops, sizeof loops / sizeof *loops, NULL, NULL);
}
