/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/screws.h"

#include "tests/support/query_helpers.h"
#include "tests/support/slip_helpers.h"

/* Pieces of endless threads: one section stands for all, and what is screwed along rests. */

/* --- Pieces ----------------------------------------------------------------------------------- */

/* q = radius + wave cos(phase), z' from `from` to `to`, z' = z - center. */
typedef struct coil {
    imp_symmetry of;
    double radius, wave, lead, from, to;
    motion map[4];
    size_t count;
} coil;

static double hand_of(const coil *c) { return c->of.kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1; }

static void coil_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const coil *c = self;
    const imp_model z = imp_shift(imp_scale(v, c->to - c->from), c->from);
    const imp_model turn = imp_mul(imp_div(imp_scale(imp_const_pi(), 2), imp_num(c->lead)), z);
    const imp_model phase = imp_sub(u, imp_scale(turn, hand_of(c)));
    const imp_model q = imp_shift(imp_scale(imp_cos(phase), c->wave), c->radius);
    imp_model sine, cosine;
    (void)t;
    imp_sincos(u, &sine, &cosine);
    out[0] = imp_shift(imp_mul(q, cosine), c->of.center[0]);
    out[1] = imp_shift(imp_mul(q, sine), c->of.center[1]);
    out[2] = imp_shift(z, c->of.center[2]);
}
IMP_SURFACE_FORMULA(coil_formula)

static void coil_domain(const void *self, double lo[3], double hi[3])
{
    whole(self, lo, hi);
    hi[0] = IMP_TWO_PI_UPPER;
}

static imp_status no_distance(const void *self, const imp_model point[4], imp_model *g)
{
    (void)self, (void)point, (void)g;
    return IMP_STATUS_UNBOUNDED;
}

static const imp_surface_type coil_type = {.struct_size = sizeof(imp_surface_type),
                                           .name = "coil",
                                           .domain = coil_domain,
                                           .destroy = keep,
                                           .eval = coil_formula_eval,
                                           .rate = coil_formula_rate,
                                           .include = coil_formula_include,
                                           .distance = no_distance,
                                           .symmetry = symmetry_of};

static void place(const coil *c, double t, long double x[3])
{
    for (size_t k = 0; k < c->count; ++k) apply(&c->map[k], t, x);
}

static void take_back(const coil *c, double t, long double x[3])
{
    for (size_t k = c->count; k > 0; --k) undo(&c->map[k - 1], t, x);
}

static const long double full_turn = 6.283185307179586476925286766559L;

static void bare_point(const coil *c, long double u, long double z, long double x[3])
{
    const long double q =
        c->radius + c->wave * cosl(u - hand_of(c) * full_turn * z / (long double)c->lead);
    x[0] = c->of.center[0] + q * cosl(u);
    x[1] = c->of.center[1] + q * sinl(u);
    x[2] = c->of.center[2] + z;
}

/* A point of the piece near x, both under its maps at t. */
static void draw_near(uint64_t *random, const coil *c, double t, double near,
                      const long double x[3], long double y[3])
{
    long double w[3] = {x[0], x[1], x[2]};
    take_back(c, t, w);
    const double way = near * (1 - random_power(random, -12, 0)),
                 angle = random_bits(random) % 2
                             ? random_between(random, -4, 4)
                             : (double)full_turn * 0.25 * (double)(random_bits(random) % 4);
    const long double u = atan2l(w[1] - c->of.center[1], w[0] - c->of.center[0]),
                      z = w[2] - c->of.center[2] + way * sin(angle);
    bare_point(c, u + 0.9 * way * cos(angle), fminl(fmaxl(z, c->from), c->to), y);
    place(c, t, y);
}

/* Screws the bare x of the piece by the angle. */
static void screw(const coil *c, long double angle, long double x[3])
{
    const long double a = x[0] - c->of.center[0], b = x[1] - c->of.center[1];
    x[0] = c->of.center[0] + cosl(angle) * a - sinl(angle) * b;
    x[1] = c->of.center[1] + sinl(angle) * a + cosl(angle) * b;
    x[2] += hand_of(c) * angle / full_turn * c->lead;
}

static bool has_height(const coil *c, const long double x[3])
{
    const long double z = x[2] - c->of.center[2];
    return z >= c->from - 1e-11L && z <= c->to + 1e-11L;
}

static long double between(const long double x[3], const long double y[3])
{
    return hypotl(hypotl(x[0] - y[0], x[1] - y[1]), x[2] - y[2]);
}

/* --- Sections --------------------------------------------------------------------------------- */

static long double dot(const double k[3], const long double x[3])
{
    return k[0] * x[0] + k[1] * x[1] + k[2] * x[2];
}

static bool is_held(const half_plane *h, const long double x[3])
{
    const long double across = dot(h->across, x), up = dot(h->up, x), rounding = 1e-17L;
    return across >= h->across_lo - rounding && across <= h->across_hi + rounding &&
           dot(h->along, x) >= h->along_lo - rounding && up >= h->height_lo - rounding &&
           up <= h->height_hi + rounding;
}

/* By which angle a screw of the piece takes its bare x into the half plane of `along`. */
static long double angle_to(const coil *c, double t, const double along[3], const long double x[3])
{
    long double way[2];
    for (int i = 0; i < 2; ++i) {
        long double from[3], to[3];
        for (int j = 0; j < 3; ++j) from[j] = to[j] = c->of.center[j];
        to[i] += 1;
        place(c, t, from);
        place(c, t, to);
        for (int j = 0; j < 3; ++j) to[j] -= from[j];
        way[i] = dot(along, to);
    }
    return atan2l(way[1], way[0]) - atan2l(x[1] - c->of.center[1], x[0] - c->of.center[0]);
}

enum { TURNS = 12, PLACES = 24 };

/* The least distance of companions in the section of points that are bare here. */
static long double least_apart(const coil c[2], const half_plane of[2], double t,
                               const long double bare[2][3])
{
    long double least = INFINITY;
    for (int cut = 0; cut < 2; ++cut)
        for (int turn = -TURNS; turn <= TURNS; ++turn) {
            const long double angle =
                angle_to(&c[cut], t, of[cut].along, bare[cut]) + turn * full_turn;
            long double x[2][3];
            bool held = true;
            memcpy(x, bare, sizeof x);
            for (int k = 0; k < 2; ++k) {
                screw(&c[k], angle, x[k]);
                held = held && has_height(&c[k], x[k]);
                place(&c[k], t, x[k]);
                held = held && is_held(&of[k], x[k]);
            }
            const long double d = between(x[0], x[1]);
            if (held && d < least) least = d;
        }
    return least;
}

static void draw_common(uint64_t *random, coil c[2])
{
    const size_t maps = random_bits(random) % 3;
    for (size_t k = 0; k < maps; ++k) {
        motion m = {.rate = 0};
        switch (random_bits(random) % 3) {
        case 0:
            m = spin_about(c[0].of.center, random_between(random, -3, 3));
            break;
        case 1:
            draw_vector(random, 2, m.way);
            break;
        default:
            m.place[0][1] = m.place[1][2] = m.place[2][0] = 1;
            m.is_placed = true;
        }
        for (int j = 0; j < 2; ++j) c[j].map[c[j].count++] = m;
    }
}

/* Two pieces about one line, or nearly, of which the second turns and moves along it; or the first
 * reaches just as far as points that are `near` apart need. */
static void draw_pieces(uint64_t *random, double near, coil c[2])
{
    const bool is_tight = random_bits(random) % 2;
    const double lead = random_between(random, 0.2, 1);
    const uint32_t kind =
        random_bits(random) % 2 ? IMP_SYMMETRY_SCREW_RIGHT : IMP_SYMMETRY_SCREW_LEFT;
    const double aside = random_bits(random) % 4 ? 0 : random_power(random, -40, -20);
    for (int k = 0; k < 2; ++k) {
        double half = lead * (random_bits(random) % 4 ? random_between(random, 0.5, 4) : 0.5);
        if (is_tight)
            half =
                k == 1 ? 0.5 * lead : 0.5 * lead + near * (random_bits(random) % 4 ? 1.0001 : 0.7);
        c[k] = (coil){.of = {.kind = kind, .is_closed = IMP_SYMMETRY_CLOSED},
                      .radius = 1 + 0.001 * k,
                      .wave = 0.1,
                      .lead = lead,
                      .from = -half,
                      .to = half};
        c[k].of.axis[2] = random_bits(random) % 2 ? lead : -lead;
    }
    draw_vector(random, 1, c[0].of.center);
    for (int i = 0; i < 3; ++i) c[1].of.center[i] = c[0].of.center[i] + (i < 2 ? aside : 0);
    for (int k = 0; k < 2; ++k) { /* the centers are beside the middles */
        const double beside = 0x1p-10 * (double)(random_bits(random) % 1024);
        c[k].of.center[2] -= beside;
        c[k].from += beside;
        c[k].to += beside;
    }
    if (!is_tight) c[1].of.center[2] += random_between(random, -1, 1);
    c[1].map[0] = spin_about(c[1].of.center, random_between(random, -4, 4));
    if (!is_tight) c[1].map[0].way[2] = random_between(random, -1, 1);
    c[1].count = 1;
    draw_common(random, c);
}

static surface *surface_of(coil *c)
{
    surface *made = surface_new(&coil_type, c);
    ck_assert_ptr_nonnull(made);
    for (size_t k = 0; k < c->count; ++k)
        ck_assert_int_eq(surface_add_map(made, &exactly, &c->map[k]), IMP_SUCCESS);
    return made;
}

/* Judges points up to `trust` times as far from each other as was asked. */
static void try_section(uint64_t *random, double trust, tally *of)
{
    static const double lo[3] = {-9, -9, -9}, hi[3] = {9, 9, 9};
    coil c[2];
    half_plane h[2];
    double slip;
    int asked;
    const double from = random_between(random, -1, 1), near = random_power(random, -6, -1);
    draw_pieces(random, near, c);
    const imp_region times = region_make(
        (double[3]){0, 0, from},
        (double[3]){1, 1, from + (random_bits(random) % 2 ? random_power(random, -6, -1) : 0)});
    surface *made[2] = {surface_of(&c[0]), surface_of(&c[1])};
    const surface *const both[2] = {made[0], made[1]};
    const half_plane_boxes boxes = {{lo, lo}, {hi, hi}};
    ck_assert_int_eq(surface_screw_section(both, &boxes, &times, near, h, &slip, &asked),
                     IMP_STATUS_OK);
    of->known += slip < INFINITY;
    for (int k = 0; k < PLACES && slip < INFINITY; ++k) {
        const double t = random_between(random, times.lo[2], times.hi[2]);
        long double x[2][3], bare[2][3];
        const double height = random_bits(random) % 2
                                  ? random_between(random, -near, near) +
                                        (random_bits(random) % 2 ? c[1].from : c[1].to)
                                  : random_between(random, c[0].from, c[0].to);
        bare_point(&c[0], random_between(random, 0, 6.28), fmax(fmin(height, c[0].to), c[0].from),
                   bare[0]);
        memcpy(x[0], bare[0], sizeof x[0]);
        place(&c[0], t, x[0]);
        draw_near(random, &c[1], t, near * trust, x[0], x[1]);
        memcpy(bare[1], x[1], sizeof x[1]);
        take_back(&c[1], t, bare[1]);
        const long double was = between(x[0], x[1]);
        if (was > near * trust) continue;
        of->judged += 1;
        of->refuted += least_apart(c, h, t, bare) > was + (long double)slip + 0x1p-46L;
    }
    surface_free(made[0]);
    surface_free(made[1]);
}

START_TEST(points_of_one_section_are_as_near)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES); ++k) try_section(&random, 1, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(5 * of.known > suite_times(CASES), "%d are known", of.known);
    ck_assert_msg(of.judged > of.known / 8, "%d are judged", of.judged);
    for (int k = 0; k < suite_times(CASES); ++k) try_section(&random, 8, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

START_TEST(sections_need_one_lead_and_hand_and_claims)
{
    static const double lo[3] = {-3, -3, -3}, hi[3] = {3, 3, 3};
    const imp_region times = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 0});
    const half_plane_boxes boxes = {{lo, lo}, {hi, hi}};
    for (int change = 0; change < 6; ++change) {
        coil c[2];
        half_plane h[2];
        double slip;
        int asked;
        for (int k = 0; k < 2; ++k)
            c[k] = (coil){.of = {.kind = IMP_SYMMETRY_SCREW_RIGHT,
                                 .is_closed = IMP_SYMMETRY_CLOSED,
                                 .axis = {0, 0, 0.5}},
                          .radius = 1,
                          .wave = 0.1,
                          .lead = 0.5,
                          .from = k == 0 ? -1 : -0.25,
                          .to = k == 0 ? 1 : 0.25};
        if (change == 1) c[0].of.is_closed = 0;
        if (change == 2) c[1].of.kind = IMP_SYMMETRY_SCREW_LEFT;
        if (change == 3) c[1].of.axis[2] = 0.5 + 1e-9;
        if (change == 4) c[1].to = 0.2;
        if (change == 5) c[0].from = -0.25;
        surface *made[2] = {surface_of(&c[0]), surface_of(&c[1])};
        const surface *const both[2] = {made[0], made[1]};
        ck_assert_int_eq(surface_screw_section(both, &boxes, &times, 0.1, h, &slip, &asked),
                         IMP_STATUS_OK);
        ck_assert_msg((slip < 1e-9) == (change == 0), "change %d: slip %g", change, slip);
        surface_free(made[0]);
        surface_free(made[1]);
    }
}
END_TEST

/* --- Rest ------------------------------------------------------------------------------------- */

/* A box of points is screwed along a piece. */
static void try_rest(uint64_t *random, double trust, tally *of)
{
    coil c[2];
    screw_rest rest;
    int asked;
    imp_model bare[2][3];
    double lo[3], hi[3];
    draw_pieces(random, 1, c);
    const double rate = random_between(random, -3, 3);
    c[0].count = c[1].count = 0;
    c[1].of.is_closed = 0;
    c[1].map[c[1].count++] = spin_about(c[0].of.center, rate);
    c[1].map[0].way[2] = hand_of(&c[0]) * rate / (double)full_turn * c[0].lead;
    draw_common(random, c);
    for (int i = 0; i < 3; ++i) {
        lo[i] = c[0].of.center[i] + (i == 0) + random_between(random, -0.1, 0.1);
        hi[i] = lo[i] + random_power(random, -6, 0);
        bare[0][i] = imp_between(c[0].of.center[i] - 4, c[0].of.center[i] + 4);
        bare[1][i] = imp_between(lo[i], hi[i]);
    }
    const double from = random_between(random, -1, 1);
    const imp_region times = region_make((double[3]){0, 0, from}, (double[3]){1, 1, from + 0.5});
    const screw_rest_times at = {&times, from, 1e-6};
    surface *made[2] = {surface_of(&c[0]), surface_of(&c[1])};
    const surface *const both[2] = {made[0], made[1]};
    ck_assert_int_eq(surface_screw_rest(both, bare, &at, &rest, &asked), IMP_STATUS_OK);
    of->known += rest.slip < INFINITY;
    of->exact += rest.slip < 1e-9;
    for (int k = 0; k < PLACES && rest.slip < INFINITY; ++k) {
        const double t = random_between(random, times.lo[2], times.hi[2]);
        long double x[3], y[3], then[3];
        for (int i = 0; i < 3; ++i)
            then[i] = y[i] = random_bits(random) % 2   ? random_between(random, lo[i], hi[i])
                             : random_bits(random) % 2 ? lo[i]
                                                       : hi[i];
        place(&c[1], t, y);
        place(&c[1], from, then);
        draw_near(random, &c[0], t, random_power(random, -4, 1), y, x);
        const long double was = between(x, y);
        if (was > rest.near * trust) continue;
        take_back(&c[0], t, x);
        screw(&c[0], -rate * (t - from), x);
        const bool held = has_height(&c[0], x);
        place(&c[0], from, x);
        of->judged += 1;
        of->refuted += !held || between(x, then) > was + (long double)rest.slip + 0x1p-46L;
    }
    surface_free(made[0]);
    surface_free(made[1]);
}

START_TEST(what_is_screwed_along_a_piece_rests)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0}, wrong = {.judged = 0};
    for (int k = 0; k < suite_times(CASES / 3); ++k) try_rest(&random, 1, &of);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(5 * of.known > suite_times(CASES / 3), "%d are known", of.known);
    ck_assert_int_gt(of.judged, 10);
    for (int k = 0; k < suite_times(CASES / 3); ++k) try_rest(&random, 8, &wrong);
    ck_assert_int_gt(wrong.refuted, 0);
}
END_TEST

/* --- Answers ---------------------------------------------------------------------------------- */

#define NUT_BY_FORMULA                                                                             \
    "formula x=(1+0.1*cos(2*pi*(v-u)))*cos(2*pi*u) y=(1+0.1*cos(2*pi*(v-u)))*sin(2*pi*u) z=0.5*v " \
    "domain=[[0,1],[-0.5,0.5]]"

typedef struct nut {
    const char *bolt, *nut;
    double distance; /* the least; by a grid over one lead, refined */
    uint64_t pairs, clearance_pairs;
} nut;

static const nut nuts[] = {
    {"thread radius=0.9 height=2", "thread radius=1 height=0.5 ! screw pitch=0.5 rate=1",
     0.06273112184, 100, 2500},
    {"thread radius=0.99 height=2", "thread radius=1 height=0.5 ! screw pitch=0.5 rate=1",
     0.00621521049, 150, 1000},
    {"thread radius=0.99 height=2", NUT_BY_FORMULA " ! screw pitch=0.5 rate=1", 0.00621521049, 150,
     1000},
    {"thread radius=0.99 height=2 ! rotate axis=1,2,3 angle=0.7",
     "thread radius=1 height=0.75 center=0,0,0.5 ! rotate axis=1,2,3 "
     "angle=0.7",
     0.00621521049, 20000, 100000},
};
enum { NUTS = sizeof nuts / sizeof *nuts };

START_TEST(nuts_are_clear_of_their_bolts)
{
    const nut *x = &nuts[_i];
    imp_error error;
    imp_registry *registry = query_registry();
    imp_scene *scene = imp_scene_from_pair(registry, x->bolt, x->nut, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    options.gamma = 0.1 * x->distance;
    options.max_pairs = 100000;
    imp_result r = {.struct_size = sizeof r};
    ck_assert_msg(imp_scene_solve(scene, &options, &r, &error) == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(r.verdict, IMP_VERDICT_CLEAR);
    ck_assert_msg(r.stats.pairs <= x->pairs, "%llu pairs", (unsigned long long)r.stats.pairs);
    for (int each = 0; each < 2; ++each) {
        imp_clearance_options asked = imp_clearance_options_default();
        asked.each = each != 0;
        query_brackets(scene, &options, &asked, x->distance, 1e-8, x->clearance_pairs);
    }
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

/* --- Slices of time --------------------------------------------------------------------------- */

enum { SLICES = 4, SLICED = 4, SLICE_PAIRS = 300 };

static imp_clearance slice_of(imp_scene *scene, double t0, double t1, uint64_t slices, size_t k)
{
    imp_error error;
    imp_options options = imp_options_default(scene);
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance r = {.struct_size = sizeof r};
    options.gamma = 1e-5;
    options.t_start = t0;
    options.t_end = t1;
    options.max_pairs = SLICE_PAIRS * slices;
    asked.slices = slices;
    asked.tolerance = 0.1;
    imp_query *query = imp_clearance_new(scene, &options, &asked, &error);
    ck_assert_msg(query != NULL, "%s", error.text);
    ck_assert_msg(imp_query_step(query, 0, &error) == IMP_SUCCESS, "%s", error.text);
    ck_assert_int_eq(imp_clearance_get(query, k, &r, &error), IMP_SUCCESS);
    imp_query_free(query);
    return r;
}

/* A nut that is screwed along a bolt, or that turns and slides in another way, or is inclined; it
 * may leave the bolt, or come to it. */
static imp_scene *draw_nut(imp_registry *registry, uint64_t *random)
{
    char bolt[200], along[300];
    imp_error error;
    const double c = random_power(random, -5, -3), rate = random_between(random, -12, 12);
    const bool slips = random_bits(random) % 4 == 0, tilts = random_bits(random) % 8 == 0;
    snprintf(bolt, sizeof bolt, "thread radius=%.17g height=%.17g", 1 - c,
             random_between(random, 0.6, 3));
    snprintf(along, sizeof along,
             "thread height=%.17g center=0,0,%.17g ! screw pitch=%.17g rate=%.17g ! rotate "
             "axis=1,0,0 angle=%.17g",
             random_between(random, 0.3, 1), 0.5 * (double)(random_bits(random) % 3),
             slips ? 0.52 : 0.5, rate, tilts ? 0.01 : 0);
    imp_scene *scene = imp_scene_from_pair(registry, bolt, along, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

START_TEST(slices_of_what_is_screwed_are_as_far_as_alone)
{
    uint64_t random = suite_seed();
    imp_registry *registry = query_registry();
    int narrow = 0;
    for (int n = 0; n < suite_times_from(SLICED, SLICED / 2); ++n) {
        imp_scene *scene = draw_nut(registry, &random);
        for (size_t k = 0; k < SLICES; ++k) {
            const imp_clearance r = slice_of(scene, 0, 1, SLICES, k),
                                s = slice_of(scene, 0.25 * (double)k, 0.25 * (double)(k + 1), 1, 0);
            ck_assert_msg(r.lower <= s.upper && s.lower <= r.upper,
                          "scene %d, slice %zu: [%.17g, %.17g], alone [%.17g, %.17g]", n, k,
                          r.lower, r.upper, s.lower, s.upper);
            ck_assert(!r.has_witness || (r.t_start <= r.t && r.t <= r.t_end));
            narrow += r.lower > 0.5 * r.upper;
        }
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
    ck_assert_int_gt(narrow, 0);
}
END_TEST

/* A ball that is screwed along a bolt, so that a slice of time is searched at one moment; later it
 * moves in another way, so that this slice's slips do not hold. */
START_TEST(slips_of_one_slice_are_not_those_of_the_next)
{
    imp_registry *registry = query_registry();
    imp_error error;
    imp_scene *scene =
        imp_scene_from_pair(registry, "thread height=8",
                            "sphere radius=0.1 center=1.3,0,-0.1 ! motion-formula angle=6*t "
                            "offset=[\"-0.05*(1-cos(5*max(t-0.5,0)))\",\"0\","
                            "\"3*t/(2*pi)+0.03*(1-cos(20*max(t-0.5,0)))\"]",
                            &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    const imp_clearance first = slice_of(scene, 0, 1, 2, 0), later = slice_of(scene, 0, 1, 2, 1),
                        alone = slice_of(scene, 0.5, 1, 1, 0);
    ck_assert_double_gt(first.lower, 0.1);
    ck_assert_double_lt(later.upper, 0.05);
    ck_assert_double_le(later.lower, alone.upper);
    ck_assert_double_le(alone.lower, later.upper);
    imp_scene_free(scene);
    imp_registry_free(registry);
}
END_TEST

int main(void)
{
    const suite_loop loops[] = {{points_of_one_section_are_as_near, 1},
                                {sections_need_one_lead_and_hand_and_claims, 1},
                                {what_is_screwed_along_a_piece_rests, 1},
                                {nuts_are_clear_of_their_bolts, NUTS},
                                {slices_of_what_is_screwed_are_as_far_as_alone, 1},
                                {slips_of_one_slice_are_not_those_of_the_next, 1}};
    return suite_main_loops("screw pieces", loops, sizeof loops / sizeof *loops, NULL, NULL);
}
