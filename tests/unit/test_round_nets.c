/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <math.h>
#include <string.h>

#include "plugins/patch/nurbs_surface.h"
#include "tests/support/suite.h"

/* Distances and symmetries of NURBS surfaces that are round or flat but for rounding, or less:
 * random rings of random profiles, anywhere in space, against points that are known to be near. */

enum { NETS = 500, PLACES = 60, POINTS_MAX = 81 };

typedef struct row {
    size_t count;
    double at[9][2], weight[9], knots[12];
} row;

/* An arc of 2 `half`, or a whole circle by four, about 0. */
static row arc_of(double half, double middle)
{
    row r = {.count = 3,
             .at = {{cos(middle - half), sin(middle - half)},
                    {cos(middle) / cos(half), sin(middle) / cos(half)},
                    {cos(middle + half), sin(middle + half)}},
             .weight = {1, cos(half), 1},
             .knots = {0, 0, 0, 1, 1, 1}};
    return r;
}

static row circle(void)
{
    static const double x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1};
    row r = {.count = 9, .knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}};
    for (int k = 0; k < 9; ++k) {
        r.at[k][0] = x[k];
        r.at[k][1] = y[k];
        r.weight[k] = k % 2 == 1 ? sqrt(0.5) : 1;
    }
    return r;
}

static row draw_ring(uint64_t *random)
{
    return random_between(random, 0, 1) < 0.3
               ? circle()
               : arc_of(random_between(random, 0.2, 1.3), random_between(random, -3, 3));
}

/* A profile of points (q, z): a line, or an arc about a point of the axis or beside it. */
static row draw_profile(uint64_t *random, int *degree)
{
    const double kind = random_between(random, 0, 5), z = random_between(random, -1, 1);
    *degree = kind < 3 ? 1 : 2;
    if (kind < 3) {
        const double q = random_between(random, 0.3, 2);
        row r = {.count = 2, .at = {{q, z}, {q, z + 1}}, .weight = {1, 1}, .knots = {0, 0, 1, 1}};
        if (kind > 1) r.at[1][0] = random_between(random, 0.3, 2);
        if (kind > 2) r.at[1][1] = z;
        return r;
    }
    row r = kind < 4 ? arc_of(random_between(random, 0.2, 0.8), random_between(random, -0.7, 0.7))
                     : draw_ring(random);
    const double radius = random_between(random, 0.3, 2);
    const double ring = kind < 4 ? 0 : 2.5 * radius;
    for (size_t k = 0; k < r.count; ++k) {
        r.at[k][0] = ring + radius * r.at[k][0];
        r.at[k][1] = z + radius * r.at[k][1];
    }
    return r;
}

static void draw_frame(uint64_t *random, double f[3][3])
{
    double length = 0;
    for (int i = 0; i < 3; ++i) f[2][i] = random_between(random, -1, 1);
    if (random_between(random, 0, 1) < 0.3) f[2][0] = f[2][1] = 0;
    for (int i = 0; i < 3; ++i) length += f[2][i] * f[2][i];
    for (int i = 0; i < 3; ++i) f[2][i] /= sqrt(length);
    const int least = fabs(f[2][0]) < 0.5 ? 0 : 1;
    length = 1 - f[2][least] * f[2][least];
    for (int i = 0; i < 3; ++i) f[0][i] = ((i == least) - f[2][least] * f[2][i]) / sqrt(length);
    for (int i = 0; i < 3; ++i)
        f[1][i] = f[2][(i + 1) % 3] * f[0][(i + 2) % 3] - f[2][(i + 2) % 3] * f[0][(i + 1) % 3];
}

/* Makes a random surface, the ring along either side, each number off by up to `off`. Returns the
 * side. */
static int draw_net_of(uint64_t *random, row ring, double off, nurbs_instance *f)
{
    int degree;
    const row profile = draw_profile(random, &degree);
    const bool along_v = random_between(random, -1, 1) < 0;
    double axes[3][3], center[3], points[3 * POINTS_MAX], weights[POINTS_MAX], bytes;
    draw_frame(random, axes);
    for (int i = 0; i < 3; ++i) center[i] = random_between(random, -3, 3);
    for (size_t i = 0; i < ring.count; ++i)
        for (size_t j = 0; j < profile.count; ++j) {
            const size_t k = along_v ? j * ring.count + i : i * profile.count + j;
            weights[k] =
                ring.weight[i] * profile.weight[j] * (1 + off * random_between(random, -1, 1));
            for (size_t axis = 0; axis < 3; ++axis)
                points[3 * k + axis] = center[axis] + off * random_between(random, -1, 1) +
                                       profile.at[j][0] * (ring.at[i][0] * axes[0][axis] +
                                                           ring.at[i][1] * axes[1][axis]) +
                                       profile.at[j][1] * axes[2][axis];
        }
    const knot_row rows[2] = {{ring.knots, ring.count + 3, 0, -1},
                              {profile.knots, profile.count + (size_t)degree + 1, 0, -1}};
    const nurbs_data data = {.degree = {along_v ? degree : 2, along_v ? 2 : degree},
                             .knots = {rows[along_v], rows[!along_v]},
                             .points = points,
                             .weights = weights};
    ck_assert(nurbs_make(f, &data, &bytes));
    return along_v;
}

static void draw_net(uint64_t *random, double off, nurbs_instance *f)
{
    draw_net_of(random, draw_ring(random), off, f);
}

static double claimed(const nurbs_instance *f, const double x[3])
{
    const imp_model point[4] = {imp_num(x[0]), imp_num(x[1]), imp_num(x[2]), imp_num(0)};
    imp_model g;
    ck_assert_int_eq(nurbs_distance(f, point, &g), IMP_STATUS_OK);
    return g.lo > 0 ? g.lo : g.hi < 0 ? -g.hi : 0;
}

/* Turns x about the axis through the center, and slides it. */
static void move(const imp_symmetry *s, double angle, const double slide[3], double x[3])
{
    double k[3], w[3], length = 0, along = 0;
    for (int i = 0; i < 3; ++i) length += s->axis[i] * s->axis[i];
    for (int i = 0; i < 3; ++i) k[i] = s->axis[i] / sqrt(length);
    for (int i = 0; i < 3; ++i) along += k[i] * (w[i] = x[i] - s->center[i]);
    for (int i = 0; i < 3; ++i) {
        const double turned = k[(i + 1) % 3] * w[(i + 2) % 3] - k[(i + 2) % 3] * w[(i + 1) % 3];
        x[i] = s->center[i] + k[i] * along + cos(angle) * (w[i] - k[i] * along) +
               sin(angle) * turned + slide[i];
    }
}

/* Moves x by some motion of the symmetry. */
static void move_within(imp_symmetry s, uint64_t *random, double x[3])
{
    double slide[3] = {0}, along = 0, length = 0;
    for (int i = 0; i < 3; ++i) {
        if (s.kind == IMP_SYMMETRY_ABOUT_POINT) s.axis[i] = random_between(random, -1, 1);
        if (s.kind == IMP_SYMMETRY_ACROSS_LINE) slide[i] = random_between(random, -1, 1);
        if (s.kind == IMP_SYMMETRY_ALONG_LINE) slide[i] = s.axis[i];
        along += slide[i] * s.axis[i];
        length += s.axis[i] * s.axis[i];
    }
    if (s.kind == IMP_SYMMETRY_ACROSS_LINE)
        for (int i = 0; i < 3; ++i) slide[i] -= along / length * s.axis[i];
    move(&s, random_between(random, -4, 4), slide, x);
}

typedef struct judgement {
    size_t kinds[IMP_SYMMETRY_ACROSS_LINE + 1];
    size_t asked, sharp;
    double beyond; /* what is claimed most beyond what is true; length */
} judgement;

static void judge_place(const nurbs_instance *f, const imp_symmetry *s, uint64_t *random,
                        judgement *all)
{
    double lo[3], hi[3], p[3], on[3], x[3], way[3], length = 0;
    nurbs_domain(f, lo, hi);
    for (int i = 0; i < 2; ++i) p[i] = random_between(random, lo[i], hi[i]);
    p[2] = 0;
    ck_assert_int_eq(nurbs_eval(f, 1, p, on, NULL), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) {
        way[i] = random_between(random, -1, 1);
        length += way[i] * way[i];
    }
    const double off = random_power(random, -50, 1);
    for (int i = 0; i < 3; ++i) x[i] = on[i] + off / sqrt(length) * way[i];
    move_within(*s, random, x);
    const double claim = claimed(f, x);
    all->asked += 1;
    all->sharp += claim > 0.3 * off;
    all->beyond = imp_larger(all->beyond, claim - off);
}

/* `kept`: the part that is subtracted of what nets are off by. */
static judgement judge_nets(double kept)
{
    judgement all = {.kinds = {0}};
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times_at_least(NETS); ++k) {
        nurbs_instance f;
        imp_symmetry s;
        memset(&s, 0, sizeof s);
        draw_net(&random, k % 3 == 0 ? random_power(&random, -52, -12) : 0, &f);
        f.round.profile.off *= kept;
        if (nurbs_symmetry(&f, &s) == IMP_STATUS_OK) {
            all.kinds[s.kind] += 1;
            for (int j = 0; j < PLACES; ++j) judge_place(&f, &s, &random, &all);
        }
        nurbs_clear(&f);
    }
    return all;
}

#define ASKED_OFF 1e-14 /* of the points that are asked about */

START_TEST(no_distance_is_greater_than_that_of_a_point_on_the_surface)
{
    const judgement all = judge_nets(1);
    for (int k = IMP_SYMMETRY_ABOUT_POINT; k <= IMP_SYMMETRY_ACROSS_LINE; ++k)
        ck_assert_uint_gt(all.kinds[k], NETS / 40);
    ck_assert_msg(all.beyond <= ASKED_OFF, "%g beyond the distance", all.beyond);
    ck_assert_uint_gt(4 * all.sharp, all.asked);
}
END_TEST

/* --- Closed but for rounding ------------------------------------------------------------------ */

/* A whole turn of four arcs, but for a gap. */
static row turn_but_for(double gap)
{
    row r = circle();
    const double half = (6.283185307179586 - gap) / 8;
    for (int k = 0; k < 9; ++k) {
        const double size = k % 2 == 1 ? 1 / cos(half) : 1;
        r.at[k][0] = size * cos(k * half);
        r.at[k][1] = size * sin(k * half);
        r.weight[k] = k % 2 == 1 ? cos(half) : 1;
    }
    return r;
}

static double apart_at(const nurbs_instance *f, int along, double u, double v, const double x[3])
{
    double p[3] = {v, v, 0}, y[3], square = 0;
    p[along] = u;
    ck_assert_int_eq(nurbs_eval(f, 1, p, y, NULL), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) square += (x[i] - y[i]) * (x[i] - y[i]);
    return sqrt(square);
}

/* The least distance of x from the ring of that v that is found, from its nearest sample, and from
 * either end of it. */
static double apart_from_ring(const nurbs_instance *f, int along, double v, const double x[3])
{
    enum { SAMPLES = 64, STARTS = 3 };
    double lo[3], hi[3], least = INFINITY;
    nurbs_domain(f, lo, hi);
    double start[STARTS] = {lo[along], hi[along], lo[along]};
    for (int k = 0; k <= SAMPLES; ++k) {
        const double u = lo[along] + k * (hi[along] - lo[along]) / SAMPLES;
        if (apart_at(f, along, u, v, x) < apart_at(f, along, start[2], v, x)) start[2] = u;
    }
    const double edge = 2 * (hi[along] - lo[along]) / SAMPLES;
    const bool is_inside = start[2] - lo[along] > edge && hi[along] - start[2] > edge;
    for (int from = is_inside ? 2 : 0; from < STARTS; ++from) {
        double width = (hi[along] - lo[along]) / SAMPLES, at = start[from];
        for (int round = 0; round < 14; ++round, width *= 0.125) {
            const double middle = at;
            for (int k = -16; k <= 16; ++k) {
                const double u =
                    imp_smaller(imp_larger(middle + 0.125 * k * width, lo[along]), hi[along]);
                if (apart_at(f, along, u, v, x) < apart_at(f, along, at, v, x)) at = u;
            }
        }
        least = imp_smaller(least, apart_at(f, along, at, v, x));
    }
    return least;
}

/* The height of x along the axis from the center, and its distance from the axis. */
static void place_in(const imp_symmetry *s, const double x[3], double at[2])
{
    double square = 0, length = 0;
    at[0] = 0;
    for (int i = 0; i < 3; ++i) length += s->axis[i] * s->axis[i];
    for (int i = 0; i < 3; ++i) at[0] += (x[i] - s->center[i]) * s->axis[i] / sqrt(length);
    for (int i = 0; i < 3; ++i) {
        const double beside = x[i] - s->center[i] - at[0] * s->axis[i] / sqrt(length);
        square += beside * beside;
    }
    at[1] = sqrt(square);
}

/* Rings with gaps of all sizes: turned about the axis, also by half the gap, either way. */
START_TEST(rings_that_are_nearly_closed_are_so_within_the_slack)
{
    uint64_t random = suite_seed();
    size_t closed = 0, open = 0;
    for (int n = 0; n < suite_times_at_least(200); ++n) {
        const double gap = random_between(&random, 0, 1) < 0.3 ? 0 : random_power(&random, -48, -2),
                     off =
                         random_between(&random, 0, 1) < 0.5 ? 0 : random_power(&random, -52, -30);
        nurbs_instance f;
        imp_symmetry s;
        memset(&s, 0, sizeof s);
        const int along = draw_net_of(&random, turn_but_for(gap), off, &f);
        const bool has = nurbs_symmetry(&f, &s) == IMP_STATUS_OK;
        if (!has || s.is_closed == 0) ++open;
        for (int k = 0; has && s.is_closed != 0 && k < 8; ++k) {
            double lo[3], hi[3], p[3] = {0}, x[3], y[3], at[2], was[2];
            const double slide[3] = {0}, angle = k < 2   ? 0.5 * gap
                                                 : k < 4 ? -0.5 * gap
                                                         : random_between(&random, -4, 4);
            nurbs_domain(&f, lo, hi);
            const double v = lo[!along] + random_between(&random, 0, 1) * (hi[!along] - lo[!along]);
            p[!along] = v;
            p[along] = k % 2 == 0 ? lo[along] : hi[along];
            ck_assert_int_eq(nurbs_eval(&f, 1, p, x, NULL), IMP_STATUS_OK);
            move(&s, angle, slide, x);
            const double apart = apart_from_ring(&f, along, v, x);
            /* all points are within 10 of the center */
            ck_assert_msg(apart <= 20 * IMP_NEARLY_SLACK, "%g apart, gap %g", apart, gap);
            p[along] = random_between(&random, lo[along], hi[along]);
            ck_assert_int_eq(nurbs_eval(&f, 1, p, y, NULL), IMP_STATUS_OK);
            place_in(&s, x, at);
            place_in(&s, y, was);
            ck_assert((s.is_closed & (along ? IMP_SYMMETRY_ORBIT_V : IMP_SYMMETRY_ORBIT_U)) != 0);
            ck_assert_double_le(hypot(at[0] - was[0], at[1] - was[1]), 20 * IMP_NEARLY_SLACK);
        }
        closed += has && s.is_closed != 0;
        ck_assert(!has || (s.is_closed != 0) == ((s.is_closed & IMP_SYMMETRY_NEARLY) != 0));
        nurbs_clear(&f);
    }
    ck_assert_uint_gt(closed, 30);
    ck_assert_uint_gt(open, 50);
}
END_TEST

/* A cone of three arcs, its profile a cubic with one control point 2^24 out, of weight 2^-24, far
 * from the surface. One end of its first ring is lowered by 2^-13. */
START_TEST(control_points_far_from_the_surface_leave_the_slack_as_it_is)
{
    enum { RING = 7, PROFILE = 8 };
    const double ring_knots[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 3};
    const double profile_knots[] = {0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8}, third = 1.0471975511965976;
    double points[3 * RING * PROFILE], weights[RING * PROFILE], bytes;
    for (int k = 0; k < RING * PROFILE; ++k) {
        const int i = k / PROFILE, j = k % PROFILE;
        const double s = j == 5 ? 0x1p24 : j, part = i % 2 == 1 ? 0.5 : 1, q = (1 + s) / part;
        points[3 * k] = q * cos(i * third);
        points[3 * k + 1] = q * sin(i * third);
        points[3 * k + 2] = s / 256 - (k == 0 ? 0x1p-13 : 0);
        weights[k] = part * (j == 5 ? 0x1p-24 : 1);
    }
    const nurbs_data data = {.degree = {2, 3},
                             .knots = {{ring_knots, 10, 0, -1}, {profile_knots, 12, 0, -1}},
                             .points = points,
                             .weights = weights};
    nurbs_instance f;
    imp_symmetry s;
    ck_assert(nurbs_make(&f, &data, &bytes));
    ck_assert_int_eq(nurbs_symmetry(&f, &s), IMP_STATUS_OK);
    ck_assert_uint_eq(s.is_closed, 0);
    nurbs_clear(&f);
}
END_TEST

/* The first test must be able to fail. */
START_TEST(what_a_net_is_off_by_has_to_be_subtracted)
{
    ck_assert_double_gt(judge_nets(0.125).beyond, ASKED_OFF);
}
END_TEST

/* An elliptic cylinder, a cylinder that moves, and one with a weight that is no product. */
START_TEST(surfaces_that_are_neither_round_nor_at_rest_have_no_distance)
{
    const row ring = arc_of(0.7, 0);
    const double ends[4] = {0, 0, 1, 1}, still[18] = {0};
    for (int k = 0; k < 3; ++k) {
        double points[18], weights[6], bytes;
        for (size_t j = 0; j < 6; ++j) {
            points[3 * j] = (k == 0 ? 1.25 : 1) * ring.at[j / 2][0];
            points[3 * j + 1] = ring.at[j / 2][1];
            points[3 * j + 2] = (double)(j % 2);
            weights[j] = ring.weight[j / 2] * (k == 2 && j == 3 ? 1.5 : 1);
        }
        const nurbs_data data = {.degree = {2, 1},
                                 .knots = {{ring.knots, 6, 0, -1}, {ends, 4, 0, -1}},
                                 .points = points,
                                 .weights = weights,
                                 .velocities = k == 1 ? still : NULL};
        nurbs_instance f;
        imp_symmetry s;
        imp_model g;
        const imp_model point[4] = {imp_num(3), imp_num(0), imp_num(0), imp_num(0)};
        ck_assert(nurbs_make(&f, &data, &bytes));
        ck_assert_int_eq(nurbs_symmetry(&f, &s), IMP_STATUS_UNBOUNDED);
        ck_assert_int_eq(nurbs_distance(&f, point, &g), IMP_STATUS_UNBOUNDED);
        nurbs_clear(&f);
    }
}
END_TEST

SUITE_MAIN("round nets", no_distance_is_greater_than_that_of_a_point_on_the_surface,
           rings_that_are_nearly_closed_are_so_within_the_slack,
           control_points_far_from_the_surface_leave_the_slack_as_it_is,
           what_a_net_is_off_by_has_to_be_subtracted,
           surfaces_that_are_neither_round_nor_at_rest_have_no_distance)
