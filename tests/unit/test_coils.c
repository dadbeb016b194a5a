/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <string.h>

#include "plugins/expression/coil_surface.h"
#include "tests/support/formula_surface.h"

/* Formulas that are found to be coils: distances from them, also of points that screw motions have
 * moved, against dense samples of the surface; and formulas that are none. */

#define TWO_PI 6.283185307179586476925286766559005768L

enum { TEXTS = 120, POINTS = 16 };

typedef struct kit {
    formula_surface of;
    coil_surface coil;
    bool is_coil;
} kit;

static kit kit_of(const formula_text *of)
{
    kit k = {.of = formula_surface_of(of)};
    k.coil.form = k.of.form.coil;
    k.coil.radius = k.of.section;
    k.is_coil = k.of.form.kind == TEXT_COIL && coil_surface_begin(&k.coil, k.of.lo, k.of.hi);
    return k;
}

/* --- Random coils ----------------------------------------------------------------------------- */

/* zeta = p phi + kappa w, all coefficients dyadic, but for 2 pi. */
static formula_text draw_text(uint64_t *random)
{
    static const double sizes[] = {0.25, 0.5, 1, -0.5, -1, 2};
    formula_text of = {.lo = {-0.25, -1}, .hi = {1, 1.5}};
    const double p = sizes[random_bits(random) % 6] * 0.5, ratio = sizes[random_bits(random) % 6];
    const double kappa = p * ratio, a[2] = {1, (double)(random_bits(random) % 3) - 1};
    const double w[2] = {(double)(random_bits(random) % 3) - 1, 1};
    const int order = 1 + (int)(random_bits(random) % 3), axis = (int)(random_bits(random) % 3);
    const bool is_mirrored = random_bits(random) % 2, in_turns = random_bits(random) % 2;
    const char *const turn = in_turns ? "2*pi*" : "";
    char radius[160], phi[64];
    snprintf(radius, sizeof radius, "(1.5+%g*cos(%s%g*(%g*u+%g*v)+0.3)+%g*sin(%g*(%s(%g*u+%g*v))))",
             random_between(random, 0.05, 0.3), turn, order * ratio, w[0], w[1],
             random_between(random, -0.1, 0.1), 2 * order * ratio, turn, w[0], w[1]);
    snprintf(phi, sizeof phi, "%s(%g*u+%g*v)+0.25", turn, a[0], a[1]);
    const int i = (axis + (is_mirrored ? 2 : 1)) % 3, j = 3 - axis - i;
    snprintf(of.text[i], sizeof of.text[i], "%s*cos(%s)+1.25", radius, phi);
    snprintf(of.text[j], sizeof of.text[j], "sin(%s)*%s", phi, radius);
    snprintf(of.text[axis], sizeof of.text[axis], "%g*u+%g*v-0.5", p * a[0] + kappa * w[0],
             p * a[1] + kappa * w[1]);
    if (!in_turns) of.lo[0] = -3, of.hi[0] = 4, of.lo[1] = -2, of.hi[1] = 3;
    return of;
}

/* Moves x by a screw motion of the symmetry. */
static void screw(const imp_symmetry *of, int axis, double angle, double x[3])
{
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const long double c = cosl(angle), s = sinl(angle);
    const long double hand = of->kind == IMP_SYMMETRY_SCREW_RIGHT ? 1 : -1;
    const long double w[2] = {(long double)x[i] - of->center[i], (long double)x[j] - of->center[j]};
    x[i] = (double)(of->center[i] + c * w[0] - s * w[1]);
    x[j] = (double)(of->center[j] + s * w[0] + c * w[1]);
    x[axis] = (double)(x[axis] + hand * angle / TWO_PI * of->axis[axis]);
}

/* What is claimed of a point. */
static double claimed(const kit *k, const double x[3])
{
    const imp_model at[3] = {imp_num(x[0]), imp_num(x[1]), imp_num(x[2])};
    const imp_model g = coil_surface_gap(&k->coil, at);
    return fabs(g.a) - g.e;
}

typedef struct tally {
    int judged, refuted, coils;
    double sharpest;
} tally;

static void judge(const kit *k, uint64_t *random, double factor, tally *of)
{
    imp_symmetry symmetry = {0};
    ck_assert_int_eq(coil_surface_symmetry(&k->coil, &symmetry), IMP_STATUS_OK);
    const int points = suite_times_from(POINTS, POINTS / 2);
    for (int n = 0; n < points; ++n) {
        const double p[3] = {random_between(random, k->of.lo[0], k->of.hi[0]),
                             random_between(random, k->of.lo[1], k->of.hi[1]), 0};
        double x[3];
        ck_assert_int_eq(expression_point(k->of.program, p, x, NULL), IMP_STATUS_OK);
        const double off = random_power(random, -16, 0);
        for (int i = 0; i < 3; ++i) x[i] += off * random_between(random, -1, 1);
        const double claim = factor * claimed(k, x);
        double most = formula_nearest(&k->of, x, 0x1p-30);
        if (claim / most > of->sharpest) of->sharpest = claim / most;
        of->refuted += claim > most * (1 + 1e-9) + 1e-12;
        screw(&symmetry, k->coil.form.along, random_between(random, -4, 4), x);
        most = formula_nearest(&k->of, x, 0x1p-30);
        of->refuted += claim > most * (1 + 1e-9) + 1e-12;
        of->judged += 2;
    }
}

/* Claims that are wrong by the factor end it where the first is refuted. */
static tally try_all(double factor)
{
    uint64_t random = suite_seed();
    tally of = {.judged = 0};
    const int times = suite_times_at_least(TEXTS / 4);
    for (int n = 0; n < times && (factor == 1 || of.refuted == 0); ++n) {
        const formula_text text = draw_text(&random);
        kit k = kit_of(&text);
        of.coils += k.is_coil;
        if (k.is_coil) judge(&k, &random, factor, &of);
        formula_surface_free(&k.of);
    }
    return of;
}

START_TEST(no_point_is_nearer_than_is_claimed)
{
    const tally of = try_all(1);
    ck_assert_msg(of.refuted == 0, "of %d %d are refuted", of.judged, of.refuted);
    ck_assert_msg(of.coils > TEXTS / 10, "%d are coils", of.coils);
    ck_assert_msg(of.sharpest > 0.8, "%g of a distance is claimed at most", of.sharpest);
}
END_TEST

/* The test above must be able to fail. */
START_TEST(distances_that_are_too_large_are_found) { ck_assert(try_all(1.25).refuted > 0); }
END_TEST

/* --- Formulas that are none ------------------------------------------------------------------- */

#define RADIUS(WAVE) "(2+0.1*cos(" WAVE "))"
#define COIL(WAVE, Z)                                                                              \
    {                                                                                              \
        {RADIUS(WAVE) "*cos(u)", RADIUS(WAVE) "*sin(u)", Z}, {0, -1}, { 6, 1 }                     \
    }

START_TEST(what_is_no_coil_is_not_taken_for_one)
{
    static const formula_text truly = COIL("4*(v+u)", "0.25*v");
    static const formula_text none[] = {
        COIL("4.1*(v+u)", "0.25*v"),        /* not periodic where v is moved by a turn */
        COIL("4*(v+u)", "0.25*v+0.01*v^2"), /* the lead changes */
        COIL("4*(v+u)+v^2", "0.25*v"),      /* no wave of a linear form */
        COIL("4*(v+u)+0*v+t", "0.25*v"),    /* moves */
        COIL("4*(v+u)+sin(v)", "0.25*v"),   /* two directions */
        COIL("4*(v+u)", "0.25*u+0.25*v+t"), /* moves */
        COIL("4*(v+u)", "0.25*u+0.25*v"),   /* kappa is 0: no graph */
        COIL("4*v", "0.25*v"),              /* p is 0: a surface of revolution */
        {{"(2+cos(4*(v+u)))*cos(u)", "(2+cos(4*(v-u)))*sin(u)", "0.25*v"}, {0, -1}, {6, 1}},
        {{"(2+cos(4*(v+u)))*cos(u)", "(2+cos(4*(v+u)))*sin(2*u)", "0.25*v"}, {0, -1}, {6, 1}},
        {{"(1+cos(4*(v+u)))*cos(u)", "(1+cos(4*(v+u)))*sin(u)", "0.25*v"}, {0, -1}, {6, 1}},
        {{"(2+v*cos(4*(v+u)))*cos(u)", "(2+v*cos(4*(v+u)))*sin(u)", "0.25*v"}, {0, -1}, {6, 1}}};
    kit k = kit_of(&truly);
    ck_assert(k.is_coil);
    formula_surface_free(&k.of);
    for (size_t n = 0; n < sizeof none / sizeof *none; ++n) {
        k = kit_of(&none[n]);
        ck_assert_msg(!k.is_coil, "text %zu: %s", n, none[n].text[0]);
        formula_surface_free(&k.of);
    }
}
END_TEST

SUITE_MAIN("coils", no_point_is_nearer_than_is_claimed, distances_that_are_too_large_are_found,
           what_is_no_coil_is_not_taken_for_one)
