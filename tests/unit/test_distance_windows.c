/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <float.h>
#include <string.h>

#include "core/bounds/distance.h"
#include "tests/support/compose.h"
#include "tests/support/suite.h"

/* Windows that random distances cut: at the times that are cut off, and at all where nodes are said
 * to be apart, the polynomial less its remainder is beyond gamma_clear everywhere; and nowhere in
 * the window is it below the bound of the distance. */

enum { CASES = 20000, PLACES = 128, MOMENTS = 8 };

/* --- A type whose distance is what is put here ------------------------------------------------ */

static imp_model claimed;

static imp_status claim(const void *self, const imp_model point[4], imp_model *distance)
{
    (void)self, (void)point;
    *distance = claimed;
    return IMP_STATUS_OK;
}

static void domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    for (int j = 0; j < 3; ++j) lo[j] = j < 2 ? 0 : -INFINITY, hi[j] = j < 2 ? 1 : INFINITY;
}

static void leave(void *self) { (void)self; }

static const imp_surface_type claiming = {.struct_size = sizeof(imp_surface_type),
                                          .name = "claiming",
                                          .domain = domain,
                                          .destroy = leave,
                                          .distance = claim};

/* --- Cases ------------------------------------------------------------------------------------ */

typedef struct place {
    long double s[2];
} place;

typedef struct trial {
    node own, other;
    time_window window;
    double size, gamma_clear;
    place places[PLACES];
    int count;
} trial;

static double draw_coefficient(uint64_t *random, double size)
{
    const uint64_t kind = random_bits(random) % 6;
    const double part = random_power(random, kind == 1 ? -60 : -6, 0);
    return kind == 0 ? 0 : size * part * random_between(random, -1, 1);
}

static void draw_claim(uint64_t *random, bool moves, double size)
{
    memset(&claimed, 0, sizeof claimed);
    claimed.a = draw_coefficient(random, size) * (random_bits(random) % 2 ? 1 : 64);
    for (int j = 0; j < 3; ++j) claimed.b[j] = draw_coefficient(random, size);
    for (int k = 0; k < 6; ++k) claimed.q[k] = draw_coefficient(random, size);
    if (random_bits(random) % 2) /* often a bowl */
        claimed.q[IMP_UU] = fabs(claimed.q[IMP_UU]), claimed.q[IMP_VV] = fabs(claimed.q[IMP_VV]);
    if (!moves) claimed.b[2] = claimed.q[IMP_UT] = claimed.q[IMP_VT] = claimed.q[IMP_TT] = 0;
    claimed.e = random_bits(random) % 3 ? 0.1 * fabs(draw_coefficient(random, size)) : 0;
    claimed.lo = -INFINITY, claimed.hi = INFINITY;
}

static long double value_at(const place *at, long double t)
{
    const long double s[3] = {at->s[0], at->s[1], t};
    long double x = claimed.a;
    for (int j = 0, k = 0; j < 3; ++j) {
        x += claimed.b[j] * s[j];
        for (int l = j; l < 3; ++l, ++k) x += claimed.q[k] * s[j] * s[l];
    }
    return x;
}

static long double normalized(const imp_region *r, long double t)
{
    return r->d[2] > 0 ? (t - r->c[2]) / r->d[2] : 0;
}

static void add_place(trial *y, long double s, long double r)
{
    if (s >= -1 && s <= 1 && r >= -1 && r <= 1 && y->count < PLACES)
        y->places[y->count++] = (place){{s, r}};
}

/* Where the polynomial may be least at time t, corners, and others. */
static void choose_places(trial *y, long double t, uint64_t *random)
{
    const double *q = claimed.q;
    const long double bs = claimed.b[0] + q[IMP_UT] * t, br = claimed.b[1] + q[IMP_VT] * t;
    const long double uu = q[IMP_UU], uv = q[IMP_UV], vv = q[IMP_VV], d = 4 * uu * vv - uv * uv;
    y->count = 0;
    if (d > 0) add_place(y, (uv * br - 2 * vv * bs) / d, (uv * bs - 2 * uu * br) / d);
    for (int end = -1; end <= 1; end += 2) {
        if (uu != 0) add_place(y, -(bs + uv * end) / (2 * uu), end);
        if (vv != 0) add_place(y, end, -(br + uv * end) / (2 * vv));
        add_place(y, end, 1), add_place(y, end, -1);
    }
    while (y->count < PLACES / 2)
        add_place(y, random_between(random, -1, 1), random_between(random, -1, 1));
}

static void draw_trial(const surface *s, uint64_t *random, trial *y)
{
    const double far = random_bits(random) % 3 ? 0 : random_power(random, 0, 30);
    double lo[3] = {0, 0, far * random_between(random, -1, 1)}, hi[3] = {1, 1, lo[2]}, ends[2];
    if (random_bits(random) % 8) hi[2] = lo[2] + random_power(random, -30, 4);
    y->own = (node){.region = region_make(lo, hi), .surface = s, .bounded = true};
    y->other = y->own;
    for (int k = 0; k < 2; ++k) {
        const bool is_inside = random_bits(random) % 2;
        ends[k] = is_inside ? lo[2] + (hi[2] - lo[2]) * random_fraction(random) : k ? hi[2] : lo[2];
        if (ends[k] > hi[2]) ends[k] = hi[2];
    }
    y->window =
        ends[0] < ends[1] ? (time_window){ends[0], ends[1]} : (time_window){ends[1], ends[0]};
    y->size = random_power(random, -20, 20);
    draw_claim(random, hi[2] > lo[2], y->size);
    const double part = random_fraction(random);
    const long double t =
        normalized(&y->own.region, y->window.lo + part * (y->window.hi - y->window.lo));
    choose_places(y, t, random);
    long double least = INFINITY;
    for (int k = 0; k < y->count; ++k) {
        const long double here = fabsl(value_at(&y->places[k], t)) - claimed.e;
        if (here < least) least = here;
    }
    const double near = random_power(random, -53, -1) * (random_bits(random) % 2 ? 1 : -1);
    y->gamma_clear = least > 0 ? (double)least * (1 + near) : 0;
}

/* Whether anything is nearer than `distance` at a time, surely; `more` is added to the remainder,
 * in parts of the size. */
static bool is_near_at(const trial *y, double distance, double t, double more)
{
    const long double s = normalized(&y->own.region, t), slack = 2048 * LDBL_EPSILON * y->size;
    for (int k = 0; k < y->count; ++k) {
        const long double least = fabsl(value_at(&y->places[k], s)) - claimed.e - more * y->size;
        if (least < distance - slack) return true;
    }
    return false;
}

typedef struct tally {
    int apart, cut, bounded, refuted,
        too_far; /* too_far: bounds of the distance that were refuted */
} tally;

static void try_cut(const trial *y, double more, uint64_t *random, tally *of)
{
    time_window left = y->window;
    distance_view view;
    imp_error error;
    const distance_question asked = {
        .a = &y->own, .b = &y->other, .gamma_clear = y->gamma_clear, .slip = INFINITY};
    ck_assert_int_eq(distance_cut(&asked, &left, &view, &error), IMP_SUCCESS);
    ck_assert(y->window.lo <= left.lo && left.lo <= left.hi && left.hi <= y->window.hi);
    if (view.is_apart) left = (time_window){y->window.hi, y->window.hi};
    of->bounded += view.lower > 0;
    of->apart += view.is_apart;
    of->cut += !view.is_apart && (left.lo > y->window.lo || left.hi < y->window.hi);
    for (int k = 0; k < MOMENTS; ++k) {
        const double f = k < 2 ? 0 : k < 4 ? 0x1.fffffp-1 : random_fraction(random);
        const bool late = !view.is_apart && k % 2;
        const double t = late ? y->window.hi - f * (y->window.hi - left.hi)
                              : y->window.lo + f * (left.lo - y->window.lo);
        const bool is_cut_off = view.is_apart || (late ? t > left.hi : t < left.lo);
        if (is_cut_off && is_near_at(y, y->gamma_clear, t, more)) of->refuted += 1;
        if (view.lower > 0 && is_near_at(y, view.lower, t, more)) of->too_far += 1;
    }
}

static tally try_all(double more)
{
    uint64_t random = suite_seed();
    tally of = {0, 0, 0, 0, 0};
    static int nothing;
    surface *s = surface_new(&claiming, &nothing);
    ck_assert_ptr_nonnull(s);
    for (int k = 0; k < suite_times(CASES); ++k) {
        trial y;
        draw_trial(s, &random, &y);
        try_cut(&y, more, &random, &of);
    }
    surface_free(s);
    return of;
}

START_TEST(nothing_is_near_at_the_times_that_a_distance_cuts_off)
{
    const tally of = try_all(0);
    ck_assert_msg(of.apart > 0 && of.cut > 0 && of.bounded > 0 && of.refuted == 0 &&
                      of.too_far == 0,
                  "%d apart, %d cut, %d refuted; %d bounded, %d refuted", of.apart, of.cut,
                  of.refuted, of.bounded, of.too_far);
}
END_TEST

/* The test above must be able to fail: of remainders that are a little larger it does. */
START_TEST(times_that_are_cut_off_too_early_and_bounds_that_are_too_high_are_found)
{
    const tally of = try_all(0x1p-20);
    ck_assert(of.refuted > 0 && of.too_far > 0);
}
END_TEST

SUITE_MAIN("distance windows", nothing_is_near_at_the_times_that_a_distance_cuts_off,
           times_that_are_cut_off_too_early_and_bounds_that_are_too_high_are_found)
