/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/common/linear.c"
#include "plugins/common/linear_bounds.c"
#include "plugins/patch/patch_include.c"
#include "tests/support/suite.h"

#include <impinge/quad.h>

/* One answer on every machine: what is compiled twice, for wide registers and for narrow ones, must
 * give the same bits. Here the copies for narrow registers stand beside the library's own, which
 * takes the wide ones where there are any; elsewhere the two are the same and nothing is shown. */

#define imp_quad_is_wide() false
#define node_take_model narrow_node_take_model
#define node_add_ball narrow_node_add_ball
#define difference_at narrow_difference_at
#define gjk_axis narrow_gjk_axis
#define fixed_axes_cut narrow_fixed_axes_cut
#define fixed_axes_cut_along narrow_fixed_axes_cut_along
#define net_bytes narrow_net_bytes
#define net_series_take narrow_net_series_take
#define net_take narrow_net_take
#define net_halve narrow_net_halve
#define net_halve_columns narrow_net_halve_columns
#define net_halving_upper narrow_net_halving_upper
#define net_halves_find narrow_net_halves_find
#define net_halves_cut narrow_net_halves_cut
#define net_points_take narrow_net_points_take
#define net_eval_at narrow_net_eval_at
#define net_heights_along narrow_net_heights_along
#define net_velocity_at narrow_net_velocity_at
#define contact_estimate_find narrow_contact_estimate_find
#define net_nearest narrow_net_nearest
#define newton_of_gap narrow_newton_of_gap
#define newton_begin narrow_newton_begin
#define newton_try narrow_newton_try
#define newton_promise narrow_newton_promise
#define newton_judge narrow_newton_judge
#define net_axis_seek narrow_net_axis_seek
#define net_axis_cut narrow_net_axis_cut
#define net_model_axis_seek narrow_net_model_axis_seek
#define net_model_axis_cut narrow_net_model_axis_cut
#include "core/bounds/difference.c"
#include "core/bounds/net_halves.h"
#include "core/tree/node_model.c"
#include "core/witness/contact_estimate.h"
#define along along_nearest
#define search search_nearest
#include "core/bounds/gjk_axis.c"
#undef along
#undef search
#include "core/bounds/fixed_axes.c"
#include "core/bounds/net_axis.c"
#include "core/bounds/net_halves.c"
#include "core/bounds/net_model_axis.c"
#include "core/tree/net.c"
#include "core/witness/contact_estimate.c"
#include "core/witness/net_eval.c"
#include "core/witness/newton.c"
#define take take_series
#define take_wide take_series_wide
#include "core/tree/net_series.c"
#undef take
#undef take_wide
#undef net_series_take
#undef imp_quad_is_wide
#undef node_take_model
#undef difference_at
#undef gjk_axis
#undef fixed_axes_cut
#undef fixed_axes_cut_along
#undef net_halve
#undef net_halves_find
#undef net_halves_cut
#undef contact_estimate_find
#undef net_nearest
#undef net_axis_seek
#undef net_axis_cut
#undef net_model_axis_seek
#undef net_model_axis_cut

const char *node_take_model(node *n, const imp_model model[3], bool may_be_infinite);
void difference_at(const node *a, const node *b, const time_window *window, difference *r);
bool gjk_axis(const difference *r, double w, vec3 *axis);
bool fixed_axes_cut(const difference *r, double gamma_clear, w_range *s, vec3 *axis,
                    gap_lines *lines);
bool fixed_axes_cut_along(const difference *r, double gamma_clear, w_range *s, vec3 axis);
void net_halve(const net *n, parameter j, int side, net *half);
void net_halves_find(const node *a, const node *b, vec3 axis, double gamma_clear,
                     const time_window *window, net_halves *halves);
bool net_halves_cut(const net_halves *halves, int side, parameter j, const time_window *window,
                    time_window left[2], bool near[2]);
bool net_series_take(const net *p, node *n);
bool contact_estimate_find(const node *a, const node *b, vec3 axis, const time_window *window,
                           double gap, contact_estimate *found);
void net_nearest(const node *const nodes[2], vec3 axis, double t, double enough, double gain,
                 double y[4]);
bool net_axis_seek(const node *a, const node *b, double t, vec3 *axis);
bool net_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear, time_window *window);
bool net_model_axis_seek(const node *a, const node *b, double t, vec3 *axis);
bool net_model_axis_cut(const node *a, const node *b, vec3 axis, double gamma_clear,
                        time_window *window);

/* What a NaN is made of is no answer. */
static bool same_bits(const void *x, const void *y, size_t numbers)
{
    for (size_t k = 0; k < numbers; ++k) {
        double a, b;
        memcpy(&a, (const char *)x + k * sizeof a, sizeof a);
        memcpy(&b, (const char *)y + k * sizeof b, sizeof b);
        if (memcmp(&a, &b, sizeof a) != 0 && (a == a || b == b)) return false;
    }
    return true;
}

/* Any number, now and then 0, huge, tiny or none. */
static double draw(uint64_t *state, double size)
{
    static const double odd[] = {0, -0.0, 1e300, -1e300, 1e-310, INFINITY, -INFINITY, NAN};
    const uint64_t kind = random_bits(state) % 512;
    return kind < 8 ? odd[kind] : kind < 50 ? 0 : size * random_between(state, -1, 1);
}

static void draw_model(uint64_t *state, double size, imp_model *m)
{
    const double bend = random_bits(state) % 4 ? size * random_power(state, -10, 0) : 0;
    memset(m, 0, sizeof *m);
    m->a = draw(state, 2);
    for (int j = 0; j < 3; ++j) m->b[j] = draw(state, size);
    for (int k = 0; k < 6; ++k) m->q[k] = draw(state, bend);
    for (int j = 0; j < 3; ++j) m->rate[j] = fabs(draw(state, 4 * size));
    m->e = fabs(draw(state, bend));
    m->lo = m->a - 8 * size;
    m->hi = m->a + 8 * size;
}

static void check_node(uint64_t *state, node *n)
{
    node narrow;
    imp_model model[3];
    const double size = random_power(state, -20, 1), lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    memset(n, 0, sizeof *n);
    n->region = region_make(lo, hi);
    narrow = *n;
    for (int i = 0; i < 3; ++i) draw_model(state, size, &model[i]);
    const bool may_be_infinite = random_bits(state) % 2;
    ck_assert_pstr_eq(node_take_model(n, model, may_be_infinite),
                      narrow_node_take_model(&narrow, model, may_be_infinite));
    ck_assert(same_bits(n, &narrow, offsetof(node, bounded) / sizeof(double)));
    ck_assert(n->bounded == narrow.bounded);
}

/* The numbers that say whose image under what a node is; not that the node is that. */
typedef struct image {
    shape_model still;
    pose_lanes pose;
} image;

static void draw_numbers(uint64_t *state, double size, void *at, size_t bytes)
{
    for (size_t k = 0; k < bytes; k += sizeof size) {
        const double x = draw(state, size);
        memcpy((char *)at + k, &x, sizeof x);
    }
}

static void make_posed(uint64_t *state, node *n, image *of)
{
    const double size = random_power(state, -20, 1);
    draw_numbers(state, size, &of->still, sizeof of->still);
    draw_numbers(state, 1, &of->pose, sizeof of->pose);
    for (int i = 0; i < 3; ++i) n->posed_e[i] = fabs(draw(state, size));
    n->still = &of->still;
    n->pose = &of->pose;
}

static void check_pair(uint64_t *state, const node *a, const node *b)
{
    const double start = random_between(state, 0, 0.9);
    const time_window window = {start, start + (1 - start) * random_power(state, -10, 0)};
    difference wide, narrow;
    memset(&wide, 0, sizeof wide); /* of what is not filled, too */
    memset(&narrow, 0, sizeof narrow);
    difference_at(a, b, &window, &wide);
    narrow_difference_at(a, b, &window, &narrow);
    ck_assert(same_bits(&wide, &narrow, sizeof wide / sizeof(double)));
    w_range s = {-1, 1}, t = s;
    vec3 n = {{draw(state, 1), draw(state, 1), draw(state, 1)}}, m = n;
    ck_assert(gjk_axis(&wide, -1, &n) == narrow_gjk_axis(&wide, -1, &m));
    ck_assert(same_bits(&n, &m, 3));
    const double gamma_clear = random_power(state, -30, 0);
    gap_lines seen, narrow_seen;
    gap_lines_begin(&seen);
    gap_lines_begin(&narrow_seen);
    wide.focus = narrow.focus = random_between(state, -1, 1);
    const bool some = fixed_axes_cut(&wide, gamma_clear, &s, &n, &seen);
    ck_assert(some == narrow_fixed_axes_cut(&wide, gamma_clear, &t, &m, &narrow_seen));
    ck_assert(same_bits(&n, &m, 3) && same_bits(&s, &t, 2));
    ck_assert_int_eq(seen.count, narrow_seen.count);
    ck_assert(same_bits(seen.line, narrow_seen.line, 2 * (size_t)seen.count));
    s = t = (w_range){-1, 1};
    ck_assert(fixed_axes_cut_along(&wide, gamma_clear, &s, n) ==
              narrow_fixed_axes_cut_along(&wide, gamma_clear, &t, n));
    ck_assert(same_bits(&s, &t, 2));
}

START_TEST(nodes_and_cuts_are_the_same_in_wide_and_narrow_registers)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        node a, b;
        image of_a, of_b;
        check_node(&state, &a);
        check_node(&state, &b);
        if (k % 4 > 1) make_posed(&state, &a, &of_a);
        if (k % 4 > 0) make_posed(&state, &b, &of_b);
        check_pair(&state, &a, &b);
    }
}
END_TEST

/* A node with a random net, its halves the same in both. */
static void check_net(uint64_t *state, node *n, net_buffer *room)
{
    imp_net given = {.degree = {3, 3}};
    net_buffer narrow;
    if (random_bits(state) % 2)
        for (int j = 0; j < 2; ++j) given.degree[j] = (uint32_t)(random_bits(state) % 4);
    given.is_moving = random_bits(state) % 2;
    given.is_weighted = random_bits(state) % 4 == 0;
    for (int i = 0; i < 3; ++i) {
        given.place[i] = random_between(state, -2, 2);
        given.drift[i] = random_between(state, -2, 2);
        for (int k = 0; k < IMP_NET_POINTS; ++k) {
            given.point[i][k] = random_between(state, -1, 1);
            given.velocity[i][k] = random_between(state, -1, 1);
            given.weight[k] = random_between(state, 0.5, 2);
        }
    }
    *n = (node){.region = region_make((double[3]){0, 0, 0}, (double[3]){1, 1, 1})};
    ck_assert(narrow_net_take(net_in(room), &given, &n->region));
    n->net = net_in(room);
    for (int k = 0; k < 4; ++k) {
        const parameter j = random_bits(state) % 2 ? PARAMETER_U : PARAMETER_V;
        const int side = (int)(random_bits(state) % 2);
        const net_buffer parent = *room;
        const net *from = (const net *)(const void *)parent.memory;
        net_halve(from, j, side, net_in(room));
        narrow_net_halve(from, j, side, net_in(&narrow));
        ck_assert(memcmp(room, &narrow, narrow_net_bytes(from)) == 0);
    }
    node wide = *n, slim = *n;
    ck_assert(net_series_take(n->net, &wide) == narrow_net_series_take(n->net, &slim));
    ck_assert(same_bits(&wide, &slim, offsetof(node, bounded) / sizeof(double)));
}

/* What follows of an axis and of a window. */
static void check_halves_and_march(const node *a, const node *b, vec3 n, const time_window *w)
{
    net_halves halves, narrow;
    time_window left[2][2] = {{*w, *w}, {*w, *w}};
    bool near[2][2] = {{true, true}, {true, true}};
    contact_estimate met = {.t = 0}, narrow_met = met;
    net_halves_find(a, b, n, 1e-3, w, &halves);
    narrow_net_halves_find(a, b, n, 1e-3, w, &narrow);
    ck_assert(halves.count == narrow.count && halves.has_heights == narrow.has_heights);
    for (int k = 0; k < halves.count; ++k)
        ck_assert(halves.found[k].side == narrow.found[k].side &&
                  halves.found[k].along == narrow.found[k].along &&
                  halves.found[k].half == narrow.found[k].half);
    for (int side = 0; side < 2; ++side) {
        ck_assert(net_halves_cut(&halves, side, PARAMETER_U, w, left[0], near[0]) ==
                  narrow_net_halves_cut(&narrow, side, PARAMETER_U, w, left[1], near[1]));
        ck_assert(same_bits(left[0], left[1], 4) && near[0][0] == near[1][0] &&
                  near[0][1] == near[1][1]);
    }
    ck_assert(contact_estimate_find(a, b, n, w, 1e-6, &met) ==
              narrow_contact_estimate_find(a, b, n, w, 1e-6, &narrow_met));
    ck_assert(same_bits(&met, &narrow_met, sizeof met / sizeof(double)));
    const node *const nodes[2] = {a, b};
    net_nearest(nodes, n, w->lo, 1e-6, 1e-4, met.y);
    narrow_net_nearest(nodes, n, w->lo, 1e-6, 1e-4, narrow_met.y);
    ck_assert(same_bits(met.y, narrow_met.y, 4));
}

START_TEST(nets_and_their_axes_are_the_same_in_wide_and_narrow_registers)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        node a, b;
        net_buffer room_a, room_b;
        check_net(&state, &a, &room_a);
        check_net(&state, &b, &room_b);
        vec3 n = {{draw(&state, 1), draw(&state, 1), draw(&state, 1)}}, m = n;
        time_window w = {random_between(&state, 0, 0.5), random_between(&state, 0.5, 1)}, v = w;
        ck_assert(net_axis_seek(&a, &b, w.lo, &n) == narrow_net_axis_seek(&a, &b, w.lo, &m));
        ck_assert(same_bits(&n, &m, 3));
        check_halves_and_march(&a, &b, n, &w);
        ck_assert(net_axis_cut(&a, &b, n, 1e-3, &w) == narrow_net_axis_cut(&a, &b, n, 1e-3, &v));
        ck_assert(same_bits(&w, &v, 2));
    }
}
END_TEST

START_TEST(axes_of_a_net_and_a_model_are_the_same_in_wide_and_narrow_registers)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        node a, b;
        net_buffer room;
        check_net(&state, &a, &room);
        check_node(&state, &b);
        if (!b.bounded) continue;
        const bool turned = random_bits(&state) % 2;
        const node *f = turned ? &b : &a, *g = turned ? &a : &b;
        vec3 n = {{draw(&state, 1), draw(&state, 1), draw(&state, 1)}}, m = n;
        time_window w = {random_between(&state, 0, 0.5), random_between(&state, 0.5, 1)}, v = w;
        ck_assert(net_model_axis_seek(f, g, w.lo, &n) ==
                  narrow_net_model_axis_seek(f, g, w.lo, &m));
        ck_assert(same_bits(&n, &m, 3));
        ck_assert(net_model_axis_cut(f, g, n, 1e-3, &w) ==
                  narrow_net_model_axis_cut(f, g, n, 1e-3, &v));
        ck_assert(same_bits(&w, &v, 2));
    }
}
END_TEST

static patch *draw_moving_patch(uint64_t *state)
{
    enum { SIDE = 5 };
    double points[3 * SIDE * SIDE], velocities[3 * SIDE * SIDE], weights[SIDE * SIDE];
    const double far = random_bits(state) % 4 ? 0 : 1e6;
    patch_data data = {.points = points};
    for (int j = 0; j < 2; ++j)
        data.degree[j] = random_bits(state) % 2 ? 3 : 1 + (int)(random_bits(state) % (SIDE - 1));
    for (int k = 0; k < 3 * SIDE * SIDE; ++k) {
        points[k] = far + random_between(state, -1, 1);
        velocities[k] = random_between(state, -1, 1);
    }
    for (int k = 0; k < SIDE * SIDE; ++k) weights[k] = random_power(state, -3, 3);
    if (random_bits(state) % 2) data.velocities = velocities;
    if (random_bits(state) % 2) data.weights = weights;
    patch *f = patch_new(&data);
    ck_assert_ptr_nonnull(f);
    return f;
}

static linear draw_linear(uint64_t *state)
{
    linear f = {.depends = {0, 0, 0, 0}};
    const uint64_t kinds = random_bits(state);
    for (int k = 0; k < LINEAR_TERMS; ++k)
        for (int i = 0; i < 3; ++i) {
            f.still[k][i] = kinds >> k & 1 ? random_between(state, -1, 1) : 0;
            f.motion[k][i] = kinds >> (8 + k) & 1 ? random_between(state, -1, 1) : 0;
        }
    return f;
}

START_TEST(linear_surfaces_are_the_same_in_wide_and_narrow_registers)
{
    uint64_t state = suite_seed();
    for (int k = 0; imp_quad_is_wide() && k < suite_times(20000); ++k) {
        linear f = draw_linear(&state), g = f;
        double lo[3], hi[3], x[2][3], error[2][3];
        finish_wide(&f);
        finish(&g);
        ck_assert(memcmp(&f, &g, sizeof f) == 0);
        for (int j = 0; j < 3; ++j) {
            lo[j] = random_between(&state, 0, 0.9);
            hi[j] = lo[j] + (random_bits(&state) % 8 ? random_power(&state, -30, -3.5) : 0);
        }
        const imp_region region = region_make(lo, hi);
        imp_model wide[3], narrow[3];
        models_wide(&f, &region, wide);
        linear_models(&f, &region, narrow);
        for (int i = 0; i < 3; ++i)
            ck_assert(same_bits(&wide[i], &narrow[i], offsetof(imp_model, depends) / 8));
        points_wide(&f, 1, lo, x[0], error[0]);
        linear_points(&f, 1, lo, x[1], error[1]);
        ck_assert(same_bits(x[0], x[1], 3) && same_bits(error[0], error[1], 3));
    }
}
END_TEST

START_TEST(patches_are_the_same_in_wide_and_narrow_registers)
{
    uint64_t state = suite_seed();
    for (int k = 0; imp_quad_is_wide() && k < suite_times(20000); ++k) {
        patch *f = draw_moving_patch(&state);
        double lo[3], hi[3];
        for (int j = 0; j < 3; ++j) {
            lo[j] = random_between(&state, 0, 0.9);
            hi[j] = lo[j] + (random_bits(&state) % 8 ? random_power(&state, -30, -3.5) : 0);
        }
        const imp_region region = region_make(lo, hi);
        imp_model wide[3], narrow[3];
        if (f->rational) {
            patch_fractions of_wide, of_narrow;
            patch_fractions_wide(f, &region, &of_wide);
            patch_fractions_of(f, &region, &of_narrow);
            memcpy(wide, of_wide.x, sizeof wide);
            memcpy(narrow, of_narrow.x, sizeof narrow);
            ck_assert(same_bits(of_wide.off, of_narrow.off, 6));
            ck_assert(same_bits(&of_wide.x[PATCH_W], &of_narrow.x[PATCH_W],
                                offsetof(imp_model, depends) / 8));
        } else {
            patch_polynomial_wide(f, &region, wide);
            patch_polynomial_of(f, &region, narrow);
        }
        for (int i = 0; i < 3; ++i)
            ck_assert(same_bits(&wide[i], &narrow[i], offsetof(imp_model, depends) / 8));
        free(f);
    }
}
END_TEST

SUITE_MAIN("lanes", nodes_and_cuts_are_the_same_in_wide_and_narrow_registers,
           nets_and_their_axes_are_the_same_in_wide_and_narrow_registers,
           axes_of_a_net_and_a_model_are_the_same_in_wide_and_narrow_registers,
           linear_surfaces_are_the_same_in_wide_and_narrow_registers,
           patches_are_the_same_in_wide_and_narrow_registers)
