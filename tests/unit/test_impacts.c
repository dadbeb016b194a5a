/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/random.h"
#include "tests/support/suite.h"
#include "tools/simulate/impact.h"

/* The law of impacts: what it promises of any two bodies, whatever their masses, inertia, motion,
 * restitution, friction and points of contact. */

/* --- Random impacts --------------------------------------------------------------------------- */

static vec random_vector(uint64_t *state, double size)
{
    vec v;
    for (int i = 0; i < 3; ++i) v.x[i] = random_between(state, -size, size);
    return v;
}

static quat random_rotation(uint64_t *state)
{
    return quat_unit((quat){random_between(state, -1, 1), random_vector(state, 1)});
}

/* Draws a body of any mass and inertia; one in eight is a thin rod. */
static impact_body random_body(uint64_t *state)
{
    impact_body b = {.yields = true, .mass = random_power(state, -6, 6)};
    const double size = random_power(state, -3, 3);
    mat3 inverse = mat3_diagonal(0);
    const bool rod = random_bits(state) % 8 == 0;
    for (int i = 0; i < 3; ++i) {
        const double part = rod ? (i == 0 ? 1e-3 : 1) : random_power(state, -4, 0);
        inverse.m[i][i] = 1 / (b.mass * size * size * part);
    }
    const mat3 axes = mat3_of_quat(random_rotation(state));
    b.inverse = mat3_turned(&axes, &inverse);
    const mat3 inertia = mat3_inverse(&b.inverse);
    b.position = random_vector(state, size);
    b.velocity = random_vector(state, 3);
    b.momentum = mat3_apply(&inertia, random_vector(state, 3 / size));
    b.spin = mat3_apply(&b.inverse, b.momentum);
    return b;
}

typedef struct impact {
    impact_body body[2];
    impact_contact contact;
} impact;

static impact random_impact(uint64_t *state)
{
    impact m = {{random_body(state), random_body(state)}, {.body = {0, 1}}};
    impact_contact *c = &m.contact;
    if (random_bits(state) % 3 == 0) {
        m.body[0].yields = false;
        m.body[0].velocity = m.body[0].momentum = m.body[0].spin = (vec){{0, 0, 0}};
    }
    c->normal = vec_unit(random_vector(state, 1));
    c->restitution = random_bits(state) % 4 == 0 ? 1 : random_fraction(state);
    c->friction = random_bits(state) % 4 == 0 ? 0 : random_power(state, -4, 2);
    c->count = random_bits(state) % 2 == 0 ? 1 : 2 + random_bits(state) % (CONTACT_POINTS - 1);
    const vec middle = random_vector(state, 1);
    for (size_t i = 0; i < c->count; ++i) { /* in one plane */
        const vec x = random_vector(state, random_power(state, -4, 1));
        c->point[i].at = vec_add(middle, vec_along(x, -vec_dot(x, c->normal), c->normal));
    }
    return m;
}

static double energy_of(const impact *m)
{
    return impact_energy(&m->body[0]) + impact_energy(&m->body[1]);
}

static vec angular_of(const impact *m)
{
    vec sum = {{0, 0, 0}};
    for (int k = 0; k < 2; ++k) {
        const impact_body *b = &m->body[k];
        sum = vec_add(
            sum, vec_add(b->momentum, vec_cross(b->position, vec_scale(b->mass, b->velocity))));
    }
    return sum;
}

/* What is drawn with this seed strikes. */
static impact struck(uint64_t seed, impact *before)
{
    *before = random_impact(&seed);
    impact after = *before;
    impact_strike(after.body, &after.contact, after.contact.restitution);
    return after;
}

enum { IMPACTS = 4000 };

/* The greatest speed of any point before. */
static double speed_of(const impact *m)
{
    double most = 0;
    for (size_t i = 0; i < m->contact.count; ++i)
        most = fmax(most, vec_length(impact_velocity(m->body, &m->contact, i)));
    return most;
}

START_TEST(no_impact_gains_energy)
{
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times(IMPACTS); ++n) {
        impact before;
        const uint64_t seed = random_bits(&state);
        const impact after = struck(seed, &before);
        ck_assert_msg(energy_of(&after) <= energy_of(&before) * (1 + 1e-12),
                      "impact %#jx: %.17g -> %.17g", (uintmax_t)seed, energy_of(&before),
                      energy_of(&after));
    }
}
END_TEST

START_TEST(bodies_part_and_pushes_stay_in_the_cone_of_friction)
{
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times(IMPACTS); ++n) {
        impact before;
        const uint64_t seed = random_bits(&state);
        const impact after = struck(seed, &before);
        const impact_contact *c = &after.contact;
        ck_assert_msg(impact_closing(after.body, c) <= 1e-6 * speed_of(&before),
                      "impact %#jx closes at %g", (uintmax_t)seed, impact_closing(after.body, c));
        double size = 0;
        for (size_t i = 0; i < c->count; ++i) size = fmax(size, vec_length(c->point[i].impulse));
        for (size_t i = 0; i < c->count; ++i) {
            const vec j = c->point[i].impulse;
            const double along = vec_dot(j, c->normal);
            const double across = vec_length(vec_along(j, -along, c->normal));
            ck_assert_msg(along >= -1e-14 * size, "impact %#jx pulls: %g of %g", (uintmax_t)seed,
                          along, size);
            ck_assert_msg(across <= c->friction * along + 1e-12 * size, "impact %#jx",
                          (uintmax_t)seed);
        }
    }
}
END_TEST

START_TEST(momentum_is_kept)
{
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times(IMPACTS); ++n) {
        impact before;
        const uint64_t seed = random_bits(&state);
        const impact after = struck(seed, &before);
        if (!before.body[0].yields) continue;
        vec sum[2] = {{{0, 0, 0}}, {{0, 0, 0}}};
        double size = 0;
        for (int k = 0; k < 2; ++k) {
            sum[0] = vec_along(sum[0], before.body[k].mass, before.body[k].velocity);
            sum[1] = vec_along(sum[1], after.body[k].mass, after.body[k].velocity);
        }
        for (size_t i = 0; i < after.contact.count; ++i)
            size += vec_length(after.contact.point[i].impulse);
        size += vec_length(sum[0]);
        ck_assert_msg(vec_length(vec_sub(sum[0], sum[1])) <= 1e-11 * size, "impact %#jx",
                      (uintmax_t)seed);
        const vec turn = vec_sub(angular_of(&before), angular_of(&after));
        ck_assert_msg(vec_length(turn) <= 1e-9 * (1 + vec_length(angular_of(&before)) + size),
                      "impact %#jx: %g", (uintmax_t)seed, vec_length(turn));
    }
}
END_TEST

START_TEST(single_points_without_friction_recoil_by_newtons_law)
{
    uint64_t state = suite_seed();
    for (int n = 0; n < suite_times(IMPACTS); ++n) {
        impact m = random_impact(&state);
        m.contact.count = 1;
        m.contact.friction = 0;
        const double speed = impact_closing(m.body, &m.contact);
        const double scale = speed_of(&m);
        impact_strike(m.body, &m.contact, m.contact.restitution);
        const double wanted = speed > 0 ? m.contact.restitution * speed : -speed;
        ck_assert_double_eq_tol(-impact_closing(m.body, &m.contact), wanted, 1e-9 * scale);
    }
}
END_TEST

/* A thin rod falls on a plane with one end, at an angle to it, sliding (Kane and Levinson). */
static impact falling_rod(double angle, double slide, double spin)
{
    impact m = {.body = {{.yields = false},
                         {.yields = true, .mass = 1, .position = {{cos(angle), 0, sin(angle)}}}},
                .contact = {.body = {0, 1},
                            .normal = {{0, 0, 1}},
                            .restitution = 0.984,
                            .friction = 0.418,
                            .count = 1}};
    m.body[1].inverse = mat3_diagonal(3); /* of half the length 1 */
    m.body[1].velocity = (vec){{slide, 0, -1}};
    m.body[1].spin = (vec){{0, spin, 0}};
    m.body[1].momentum = vec_scale(1.0 / 3, m.body[1].spin);
    return m;
}

START_TEST(rods_that_newtons_and_coulombs_laws_would_speed_up_are_not)
{
    int gained = 0, falls = 0;
    for (double angle = 0.1; angle < 1.5; angle += 0.1)
        for (double slide = -4; slide <= 4; slide += 0.25)
            for (double spin = -2; spin <= 2; spin += 1) {
                impact m = falling_rod(angle, slide, spin), newton = m;
                const double before = energy_of(&m);
                const double closing = impact_closing(m.body, &m.contact);
                if (!(closing > 0)) continue;
                newton.contact.point[0].target = newton.contact.restitution * closing;
                double gain;
                ck_assert(impact_solve(newton.body, &newton.contact, 1, true, &gain));
                gained += gain > 1e-3 * before;
                impact_strike(m.body, &m.contact, m.contact.restitution);
                ck_assert_double_le(energy_of(&m), before * (1 + 1e-14));
                ++falls;
            }
    printf("%d of %d falls of a rod gain energy by Newton's and Coulomb's laws\n", gained, falls);
    ck_assert_int_gt(gained, 10);
}
END_TEST

/* A box lands flat on a plane: all four corners push alike, and it does not turn. */
START_TEST(a_box_that_lands_flat_rises_flat)
{
    for (int k = 0; k <= 10; ++k) {
        impact m = falling_rod(1, 0, 0);
        m.body[1].position = (vec){{0.5, 0.5, 0.5}};
        m.contact.restitution = k / 10.0;
        m.contact.count = 4;
        for (int i = 0; i < 4; ++i) m.contact.point[i].at = (vec){{i % 2, i / 2, 0}};
        impact_strike(m.body, &m.contact, m.contact.restitution);
        ck_assert_double_eq_tol(m.body[1].velocity.x[2], k / 10.0, 1e-12);
        ck_assert_double_le(vec_length(m.body[1].spin), 1e-11);
    }
}
END_TEST

SUITE_MAIN("impacts", no_impact_gains_energy, bodies_part_and_pushes_stay_in_the_cone_of_friction,
           momentum_is_kept, single_points_without_friction_recoil_by_newtons_law,
           rods_that_newtons_and_coulombs_laws_would_speed_up_are_not,
           a_box_that_lands_flat_rises_flat)
