/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/bounds/fixed_axes.h"
#include "core/bounds/normal_field.h"
#include "core/bounds/separation.h"
#include "core/tree/pose.h"
#include "tests/support/meeting.h"

/* Pairs of images of shapes under poses, brought together exactly within gamma_clear at a chosen
 * moment, at points where remainders reach farthest toward each other: no cut may lose that moment.
 * Some are tubes, whose balls reach toward each other, too. In long double. */

typedef struct image {
    imp_model shape[3];
    imp_pose pose;
    double ball;
    shape_model still;
    pose_lanes lanes;
    node n;
} image;

/* Where a point is: s_u and s_v, and at which share of each remainder. */
typedef struct place {
    double s[2], off[3], turn_off[3][3], shift_off[3];
} place;

typedef struct meeting {
    image a, b;
    time_window window;
    double t, gamma_clear;
    vec3 along; /* the direction in which they meet */
} meeting;

static double draw(uint64_t *state, double most) { return most * random_between(state, -1, 1); }

static void range_whole(imp_model *m)
{
    m->lo = -INFINITY, m->hi = INFINITY;
    const imp_interval range = imp_model_poly_range(m);
    m->lo = range.lo, m->hi = range.hi;
}

static imp_model draw_shape(uint64_t *state, double bend, double e)
{
    imp_model m = imp_num(draw(state, 1));
    for (int j = 0; j < 2; ++j) m.b[j] = draw(state, 1), m.rate[j] = 4;
    m.q[IMP_UU] = draw(state, bend), m.q[IMP_UV] = draw(state, bend),
    m.q[IMP_VV] = draw(state, bend);
    m.depends = 3;
    m.e = e * random_power(state, -3, 0);
    range_whole(&m);
    return m;
}

static imp_model draw_in_time(uint64_t *state, double size, double rate, double e)
{
    imp_model m = imp_num(draw(state, size));
    m.b[2] = draw(state, rate), m.q[IMP_TT] = draw(state, rate * rate), m.rate[2] = 4;
    m.depends = 4;
    m.e = e * random_power(state, -3, 0);
    range_whole(&m);
    return m;
}

static void fill(image *x, double start, double end)
{
    double norm = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) norm += imp_interval_mag(imp_model_range(&x->pose.turn[i][j]));
    x->n = (node){.region = region_make((double[3]){0, 0, start}, (double[3]){1, 1, end})};
    ck_assert(shape_model_take(&x->still, x->shape));
    x->still.ball = x->ball;
    pose_take(&x->lanes, &x->pose, norm);
    ck_assert(node_take_posed(&x->n, &x->still, &x->lanes));
    ck_assert_ptr_nonnull(x->n.pose);
    for (int i = 0; i < 3; ++i) x->n.lo[i] = -INFINITY, x->n.hi[i] = INFINITY;
}

static void draw_image(uint64_t *state, image *x)
{
    const double bend = random_power(state, -10, 0), rate = random_power(state, -10, 0);
    const double e = random_bits(state) % 4 ? random_power(state, -12, 0) : 0;
    const double error = random_bits(state) % 2 ? random_power(state, -12, 0) * e : 0;
    memset(x, 0, sizeof *x);
    x->ball = random_bits(state) % 3 ? 0 : random_power(state, -10, 1);
    for (int i = 0; i < 3; ++i) {
        x->shape[i] = draw_shape(state, bend, e);
        x->pose.shift[i] = draw_in_time(state, 1, rate, error);
        x->pose.pivot[i] = random_bits(state) % 2 ? 0 : draw(state, 1);
        for (int j = 0; j < 3; ++j) x->pose.turn[i][j] = draw_in_time(state, 1, rate, error);
    }
}

/* The other image, but for a little of it, and perhaps turning otherwise: so that normals are
 * nearly parallel for some time. */
static void draw_alike(uint64_t *state, const image *of, image *x)
{
    const double little = random_power(state, -20, -4);
    const double otherwise = random_bits(state) % 2 ? random_power(state, -4, 0) : little;
    *x = *of;
    for (int i = 0; i < 3; ++i) {
        x->shape[i].q[IMP_UU] += draw(state, little);
        x->shape[i].q[IMP_VV] += draw(state, little);
        range_whole(&x->shape[i]);
        for (int j = 0; j < 3; ++j) {
            x->pose.turn[i][j].b[2] += draw(state, otherwise);
            range_whole(&x->pose.turn[i][j]);
        }
    }
}

static long double in_time(const imp_model *m, long double s, double off)
{
    return m->a + m->b[2] * s + m->q[IMP_TT] * s * s + (long double)off * m->e;
}

static void point(const image *x, const place *at, double t, long double p[3])
{
    const long double s = ((long double)t - x->n.region.c[2]) / x->n.region.d[2];
    const long double u = at->s[0], v = at->s[1];
    long double z[3];
    for (int j = 0; j < 3; ++j) {
        const imp_model *m = &x->shape[j];
        z[j] = m->a + m->b[0] * u + m->b[1] * v + m->q[IMP_UU] * u * u + m->q[IMP_UV] * u * v +
               m->q[IMP_VV] * v * v + (long double)at->off[j] * m->e - x->pose.pivot[j];
    }
    for (int i = 0; i < 3; ++i) {
        p[i] = in_time(&x->pose.shift[i], s, at->shift_off[i]);
        for (int j = 0; j < 3; ++j)
            p[i] += in_time(&x->pose.turn[i][j], s, at->turn_off[i][j]) * z[j];
    }
}

static long double height(const image *x, const place *at, double t, vec3 n)
{
    long double p[3];
    point(x, at, t, p);
    return n.x[0] * p[0] + n.x[1] * p[1] + n.x[2] * p[2];
}

/* The sign of each share that moves the point along n. */
static void push(const image *x, double t, vec3 n, place *at)
{
    double *const share = at->off;
    enum { SHARES = 3 + 9 + 3 };
    _Static_assert(sizeof(place) == (2 + SHARES) * sizeof *share, "shares lie side by side");
    for (int k = 0; k < SHARES; ++k) {
        share[k] = 1;
        const long double above = height(x, at, t, n);
        share[k] = -1;
        if (above > height(x, at, t, n)) share[k] = 1;
    }
}

/* A point of those that lie farthest along n. */
static place farthest(uint64_t *state, const image *x, double t, vec3 n)
{
    place best;
    memset(&best, 0, sizeof best);
    push(x, t, n, &best);
    for (int k = 0; k < 24; ++k) {
        place next = best;
        for (int j = 0; j < 2; ++j)
            if (random_bits(state) % 2) next.s[j] = suite_end_or_inside(state);
        push(x, t, n, &next);
        if (height(x, &next, t, n) > height(x, &best, t, n)) best = next;
    }
    return best;
}

static void draw_meeting(uint64_t *state, meeting *m, bool alike)
{
    draw_image(state, &m->a);
    if (alike)
        draw_alike(state, &m->a, &m->b);
    else
        draw_image(state, &m->b);
    fill(&m->a, 0, 1);
    fill(&m->b, alike ? 0 : draw(state, 1) - 1, alike ? 1 : 2);
    m->t = draw_moment(state, -6, &m->window);
    m->gamma_clear = random_power(state, -14, 0);
    for (int i = 0; i < 3; ++i) m->along.x[i] = draw(state, 1);
    if (alike && random_bits(state) % 4) m->along = node_normal(&m->a.n);
    m->along = vec3_scale(m->along, 1 / vec3_norm(m->along));
}

/* Moves B so that its lowest point is above A's highest by gamma_clear times `share`. What the mean
 * of the places is rounded by is far less than what 1e-9 leaves. */
static void bring_together(uint64_t *state, meeting *m, double share)
{
    long double pa[3], pb[3];
    const vec3 back = vec3_scale(m->along, -1);
    const place a = farthest(state, &m->a, m->t, m->along), b = farthest(state, &m->b, m->t, back);
    point(&m->a, &a, m->t, pa);
    point(&m->b, &b, m->t, pb);
    const double apart = m->gamma_clear * share + m->a.ball + m->b.ball;
    for (int i = 0; i < 3; ++i) m->b.n.f.a[i] += (double)(pa[i] - pb[i] + m->along.x[i] * apart);
}

START_TEST(a_meeting_of_turning_nodes_is_never_cut_away)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(8000); ++k) {
        meeting m;
        draw_meeting(&state, &m, k % 2);
        bring_together(&state, &m, 1 - 1e-9);
        time_window left = m.window;
        vec3 axis = m.along;
        const bool some = separation_window(&m.a.n, &m.b.n, m.gamma_clear, &left, &axis, NULL);
        check_window_left(&m.window, m.t, some, &left, k);
    }
}
END_TEST

START_TEST(neither_axes_nor_field_of_normals_lose_a_meeting_alone)
{
    uint64_t state = suite_seed() + 1;
    for (int k = 0; k < suite_times(16000); ++k) {
        meeting m;
        draw_meeting(&state, &m, k % 4 != 0);
        bring_together(&state, &m, 1 - 1e-9);
        difference r;
        w_range axes = {-1, 1}, given = {-1, 1}, field = {-1, 1};
        vec3 axis = m.along;
        difference_at(&m.a.n, &m.b.n, &m.window, &r);
        check_share_left(&r, m.t, fixed_axes_cut_along(&r, m.gamma_clear, &given, m.along), &given,
                         k);
        check_share_left(&r, m.t, fixed_axes_cut(&r, m.gamma_clear, &axes, &axis, NULL), &axes, k);
        check_share_left(&r, m.t, normal_field_cut(&r, axis, m.gamma_clear, &field, NULL), &field,
                         k);
    }
}
END_TEST

START_TEST(no_gap_of_turning_nodes_is_below_the_lower_bound_of_the_distance)
{
    uint64_t state = suite_seed() + 2;
    for (int k = 0; k < suite_times(6000); ++k) {
        meeting m;
        draw_meeting(&state, &m, k % 2);
        bring_together(&state, &m, 1);
        time_window left = m.window;
        vec3 axis = m.along;
        approach near = {NAN, m.t};
        const double above = m.gamma_clear * (1 + 1e-9);
        const bool some = separation_approach(&m.a.n, &m.b.n, above, &left, &axis, &near);
        ck_assert_msg(some && near.lower <= above, "case %d: %g apart, lower bound %g", k,
                      m.gamma_clear, near.lower);
    }
}
END_TEST

static bool is_parted(const node *a, const node *b, const meeting *m)
{
    time_window left = m->window;
    vec3 axis = m->along;
    return !separation_window(a, b, m->gamma_clear, &left, &axis, NULL);
}

/* Counts the pairs that a box hardly parts. */
START_TEST(turning_remainders_part_more_than_boxes_do)
{
    uint64_t state = suite_seed() + 3;
    int by_box = 0, by_terms = 0;
    for (int k = 0; k < suite_times(4000); ++k) {
        meeting m;
        draw_meeting(&state, &m, false);
        m.gamma_clear = 1;
        bring_together(&state, &m, 1 + random_power(&state, -4, 1));
        node a = m.a.n, b = m.b.n;
        by_terms += is_parted(&a, &b, &m);
        a.pose = b.pose = NULL;
        a.ball = b.ball = 0; /* e has it */
        by_box += is_parted(&a, &b, &m);
    }
    ck_assert_msg(by_terms > 1.05 * by_box, "%d, and %d by boxes", by_terms, by_box);
}
END_TEST

SUITE_MAIN("posed pairs", a_meeting_of_turning_nodes_is_never_cut_away,
           neither_axes_nor_field_of_normals_lose_a_meeting_alone,
           no_gap_of_turning_nodes_is_below_the_lower_bound_of_the_distance,
           turning_remainders_part_more_than_boxes_do)
