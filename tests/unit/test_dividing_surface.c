/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/dividing_surface.c"
#include "tests/support/suite.h"

/* The height above a dividing surface (dividing_surface.h), term by term: what is computed of it
 * and the bound of what is left out, against the height of points. */

/* A size of terms that are all there, small or left out. */
static double random_size(uint64_t *state)
{
    static const double sizes[] = {0, 1e-3, 0.03, 0.3, 1, 3};
    return sizes[random_bits(state) % (sizeof sizes / sizeof *sizes)];
}

static double random_within(uint64_t *state, double size)
{
    return size * random_between(state, -1, 1);
}

static local random_local(uint64_t *state, double size)
{
    return (local){{random_within(state, size), random_within(state, size)},
                   random_within(state, size)};
}

static void random_side(uint64_t *state, local_slice *s)
{
    const double slopes = random_size(state), bends = random_size(state);
    const double swings = random_size(state), change = random_size(state);
    for (int k = 0; k < 2; ++k) s->l[k] = random_local(state, slopes);
    for (int k = 0; k < SECONDS; ++k) s->q[k] = random_local(state, k < UW ? bends : swings);
    for (int k = 0; k < 3; ++k) s->qw[k] = random_within(state, change);
}

static dividing random_dividing(uint64_t *state)
{
    const double slope = random_size(state), bend = random_size(state);
    const double third = random_size(state), fourth = random_size(state);
    dividing h;
    for (int i = 0; i < 2; ++i) h.slope[i] = random_within(state, slope);
    h.k =
        (form){random_within(state, bend), random_within(state, bend), random_within(state, bend)};
    for (int k = 0; k < 4; ++k) h.c.x[k] = random_within(state, third);
    for (int k = 0; k < 5; ++k) h.q.x[k] = random_within(state, fourth);
    return h;
}

/* h(p). */
static double value_at(const dividing *h, const double *p)
{
    const form twice = quartic_by_two(&h->q, p, p);
    return h->slope[0] * p[0] + h->slope[1] * p[1] + 0.5 * form_of(&h->k, p, p) +
           cubic_of(&h->c, p, p, p) / 6 + form_of(&twice, p, p) / 24;
}

/* f of a point of one side, at random parameters; *quadratic: its part as computed; *size grows by
 * the size of terms. */
static double height_at(uint64_t *state, const dividing *h, const local_view *v, const double *mw,
                        double w, int side, const quadratics *parts, double *quadratic,
                        double *size)
{
    const local_slice *of = side == 0 ? &v->a : &v->b;
    const double s = suite_end_or_inside(state), r = suite_end_or_inside(state);
    const double z[SECONDS] = {s * s, s * r, r * r, s * w, r * w}, way = side - 0.5;
    const path *x = &v->x;
    double p[2], up = way * (x->delta.n + (x->drift.n + x->bend.n * w) * w);
    for (int i = 0; i < 2; ++i) {
        p[i] = way * (x->delta.t[i] + (x->drift.t[i] + x->bend.t[i] * w) * w) + of->l[0].t[i] * s +
               of->l[1].t[i] * r;
        for (int k = 0; k < SECONDS; ++k) p[i] += of->q[k].t[i] * z[k];
    }
    up += of->l[0].n * s + of->l[1].n * r;
    for (int k = 0; k < SECONDS; ++k) up += (of->q[k].n + (k < UW ? w * of->qw[k] : 0)) * z[k];
    const imp_quad *const all[] = {&parts->bs, &parts->br, &parts->qss, &parts->qsr, &parts->qrr};
    const double powers[] = {s, r, s * s, s * r, r * r};
    for (int k = 0; k < 5; ++k) {
        const double start = (*all[k])[side], end = (*all[k])[2 + side];
        *quadratic += 0.5 * (start + end + w * (end - start)) * powers[k];
        *size += fabs(start) + fabs(end);
    }
    *size += fabs(up) + fabs(value_at(h, p));
    return up + w * (mw[0] * p[0] + mw[1] * p[1]) - value_at(h, p);
}

START_TEST(what_is_left_out_of_a_height_is_within_its_bound)
{
    uint64_t state = suite_seed() + 1;
    double most = 0;
    for (int k = 0; k < suite_times(400000); ++k) {
        local_view v;
        random_side(&state, &v.a);
        random_side(&state, &v.b);
        v.x = (path){random_local(&state, random_size(&state)),
                     random_local(&state, random_size(&state)),
                     random_local(&state, random_size(&state))};
        const dividing h = random_dividing(&state);
        const double rate = random_size(&state);
        const double mw[2] = {random_within(&state, rate), random_within(&state, rate)};
        const place p[2] = {place_at(&h, &v.x, -1), place_at(&h, &v.x, 1)};
        const height to = height_between(p, &v, mw);
        const double w = suite_end_or_inside(&state), left = left_out_upper(&h, p, &v, mw);
        double sum = to.offset + (to.drift + to.bend * w) * w, size = 1;
        const double a = height_at(&state, &h, &v, mw, w, 0, &to.parts, &sum, &size);
        const double b = height_at(&state, &h, &v, mw, w, 1, &to.parts, &sum, &size);
        const double off = fabs(b - a - sum);
        ck_assert_msg(off <= left * (1 + 1e-9) + 1e-11 * size, "case %d: %g left out, bound %g", k,
                      off, left);
        if (left > 1e-6 * size && off / left > most) most = off / left;
    }
    ck_assert_msg(most > 0.9, "at most %g of a bound is reached", most);
}
END_TEST

/* Two equal surfaces, one on the other: h follows them up to terms of fifth order. */
START_TEST(the_surface_chosen_takes_off_terms_of_third_and_fourth_order)
{
    uint64_t state = suite_seed() + 2;
    for (int k = 0; k < suite_times(10000); ++k) {
        const frame f = {.side = {TOUCH_FACE, TOUCH_FACE}};
        const form bend = {random_within(&state, 1), random_within(&state, 1),
                           random_within(&state, 1)};
        const quartic none = {{0, 0, 0, 0, 0}};
        local_view v = {.x = {{{0, 0}, 0}, {{0, 0}, 0}, {{0, 0}, 0}}};
        random_side(&state, &v.a);
        v.a.l[0] = (local){{1, random_within(&state, 0.5)}, 0};
        v.a.l[1] = (local){{random_within(&state, 0.5), 1}, 0};
        for (int j = UU; j <= VV; ++j) v.a.q[j] = random_local(&state, 0.1);
        v.b = v.a;
        dividing h;
        ck_assert(dividing_choose(&f, &v, &bend, &h));
        const place p = place_at(&h, &v.x, 1);
        ck_assert_double_lt(third_upper(&p, &v.a), 1e-14);
        ck_assert_double_lt(fourth_upper(&h.q, &p, &v.a), 1e-14);
        ck_assert_double_gt(fourth_upper(&none, &p, &v.a), 1e-12);
    }
}
END_TEST

SUITE_MAIN("dividing_surface", what_is_left_out_of_a_height_is_within_its_bound,
           the_surface_chosen_takes_off_terms_of_third_and_fourth_order)
