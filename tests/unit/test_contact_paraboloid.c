/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/contact_paraboloid.h"

#include "tests/support/suite.h"

/* Forms x x, x y, y y of a face's curvature. */
typedef struct bends {
    double xx, xy, yy;
} bends;

static double along(const bends *q, double x, double y)
{
    return q->xx * x * x + 2 * q->xy * x * y + q->yy * y * y;
}

/* A face over the plane z = 0, whose u and v are x and y. */
static net_derivatives face_of(const bends *q)
{
    net_derivatives d = {0};
    d.by[NET_U][0] = d.by[NET_V][1] = 1;
    d.by[NET_UU][2] = q->xx;
    d.by[NET_UV][2] = q->xy;
    d.by[NET_VV][2] = q->yy;
    return d;
}

static void choose(const bends *a, const bends *b, net_paraboloid *d)
{
    const net_derivatives of[2] = {face_of(a), face_of(b)};
    const contact_side sides[2] = {{&of[0], {true, true}}, {&of[1], {true, true}}};
    contact_paraboloid_choose(sides, (vec3){{0, 0, 1}}, d);
}

/* The paraboloid's curvature in a direction of the plane. */
static double bend_of(const net_paraboloid *d, double x, double y)
{
    double sum = 0;
    for (int i = 0; i < 2; ++i) {
        const double by = d->across[i].x[0] * x + d->across[i].x[1] * y;
        sum += d->bend[i] * by * by;
    }
    return sum;
}

static void is_between(const bends *a, const bends *b, const net_paraboloid *d)
{
    ck_assert_double_eq_tol(vec3_norm(d->across[0]), 1, 1e-14);
    ck_assert_double_eq_tol(vec3_norm(d->across[1]), 1, 1e-14);
    ck_assert_double_eq_tol(vec3_dot(d->across[0], d->across[1]), 0, 1e-14);
    ck_assert_double_eq_tol(d->normal.x[2], 1, 1e-14);
    for (int k = 0; k < 16; ++k) {
        const double x = cos(k * 0.2), y = sin(k * 0.2);
        ck_assert_double_ge(bend_of(d, x, y), along(a, x, y) - 1e-11);
        ck_assert_double_le(bend_of(d, x, y), along(b, x, y) + 1e-11);
    }
}

/* B's form is A's plus a sum of two squares. A bends up somewhere, so that no plane serves. */
START_TEST(between_two_faces_the_paraboloid_bends_more_than_one_and_less_than_the_other)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(2000); ++k) {
        bends a = {random_power(&state, -3, 2), random_between(&state, -9, 9),
                   random_between(&state, -9, 9)};
        if (k % 4 == 1) a.xy = 0;
        if (k % 4 == 2) a.yy = a.xx;
        bends b = a;
        for (int i = 0; i < 2; ++i) {
            const double x = random_between(&state, -3, 3),
                         y = k % 4 == 1 ? 0 : random_between(&state, -3, 3);
            b.xx += i == 0 ? x * x : y * y;
            b.xy += i == 0 ? x * y : -x * y;
            b.yy += i == 0 ? y * y : x * x;
        }
        net_paraboloid d;
        choose(&a, &b, &d);
        is_between(&a, &b, &d);
    }
}
END_TEST

/* The eigenvectors of a diagonal form, and of one whose squares underflow, are the axes. */
START_TEST(axes_of_simple_forms_are_exact)
{
    const bends forms[] = {{4, 0, 1}, {1, 0, 4}, {2, 0, 2}, {0x1p-600, 0, 0}, {1, 3, 1}};
    for (int k = 0; k < 5; ++k) {
        net_paraboloid d;
        choose(&forms[k], &forms[k], &d);
        is_between(&forms[k], &forms[k], &d);
        ck_assert(k == 4 || fabs(d.across[0].x[0]) == (k == 1 ? 0 : 1));
        if (k == 4) ck_assert_double_eq_tol(d.across[0].x[0], sqrt(0.5), 1e-15);
        ck_assert_double_ge(d.bend[0], d.bend[1]);
    }
}
END_TEST

SUITE_MAIN("contact_paraboloid",
           between_two_faces_the_paraboloid_bends_more_than_one_and_less_than_the_other,
           axes_of_simple_forms_are_exact)
