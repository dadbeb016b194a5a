/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/near.h"
#include "plugins/common/publish.h"

#include <impinge/formula.h>
#include <impinge/formula_text.h>
#include <impinge/plugin.h>

/* A sphere with narrow peaks (paper, eqs. 8 and 9): sampling can miss such peaks, bounds cannot. A
 * peak repeats with every turn in longitude, so that the surface closes at its seam. */

enum { RADIUS, HEIGHT, WIDTH, SPIKES, CENTER };

#define WIDTH_MAX 3.141592653589793 /* a wider peak would need dozens of turns */

static const imp_parameter parameters[] = {
    [RADIUS] = IMP_ROW_POSITIVE("radius", "length", "1", "radius of the sphere"),
    [HEIGHT] = IMP_ROW_NUMBER("height", "length", "1", "height of a spike; negative: a dent"),
    [WIDTH] = IMP_ROW("width", "rad", "0.2", 0, 0, 0, 0, 1e-100, WIDTH_MAX,
                      "distance from its top at which a spike falls to 1/e of its height"),
    [SPIKES] = IMP_ROW("spikes", "rad", "[[0,0]]", 0, 2, 0, 2, -100, 100,
                       "[longitude, latitude] of each spike"),
    [CENTER] = IMP_ROW_CENTER,
};

typedef struct peak {
    near_constant u; /* given_u + 2 pi turn */
    double v, given_u;
    int turn;
} peak;

typedef struct spike_instance {
    double radius, height, center[3];
    near_constant steepness; /* 1 / width^2 */
    double slope;            /* at least 2 / width */
    double left_out;         /* upper bound of what omitted peaks add to peaks_far's `rest` */
    size_t count;
    peak peaks[]; /* with their repetitions */
} spike_instance;

/* 2 pi = TURN_HIGH + TURN_LOW + r, |r| < 2^-93; TURN_HIGH is a multiple of 2^-37 below 2^3. */
#define TURN_HIGH 0x1.921fb54442p+2
#define TURN_LOW 0x1.a308d313198a3p-39
#define TURNS_MAX 40 /* beyond the reach of the widest at +-100 rad */

/* u + 2 pi turn. Lemma. |turn| <= 40 < 2^6, so turn TURN_HIGH has at most 46 bits and is exact.
 *   s = fl(u + turn TURN_HIGH)      off by   U |s|
 *   p = fl(turn TURN_LOW)           off by   U |p| < 2^-53 2^6 2^-38 = 2^-85
 *   value = fl(s + p)               off by   U |value|
 *   turn r                          is       < 2^6 2^-93 = 2^-87
 * |s| <= |value| (1 + 2 U) + |p|, so the sum is below (2 U + 4 U^2) |value| + 2^-83. */
static near_constant turned(double u, int turn)
{
    if (turn == 0) return near_exact(u);
    const double value = (u + turn * TURN_HIGH) + turn * TURN_LOW;
    return (near_constant){value, 0x1.001p-52 * fabs(value) + 0x1p-83};
}

/* Least distance of a peak's top from the domain, in widths, at which its exponential is 0 in
 * double precision: exp(-26.7^2) < 2^-1022. */
#define REACH 26.7

/* Peaks that are farther are omitted. All omitted turns of one spike add up to at most LEFT_OUT in
 * the sum of exp(-3/4 r^2): turns are at least two widths apart, so that on either side each term
 * is at most half of the one before; 4 exp(-3/4 26.6^2) < 2^-763. */
#define LEFT_OUT 0x1p-763

static bool is_in_reach(near_constant u, double width)
{
    double distance = imp_larger(-u.value, u.value - IMP_TWO_PI_UPPER) - u.error;
    return distance <= REACH * width;
}

/* Writes the peak's repetitions to `to` unless it is NULL. Returns their number. */
static size_t repeat(peak top, double width, peak *to)
{
    size_t count = 0;
    for (int turn = -TURNS_MAX; turn <= TURNS_MAX; ++turn) {
        peak image = {turned(top.u.value, turn), top.v, top.u.value, turn};
        if (!is_in_reach(image.u, width)) continue;
        if (to != NULL) to[count] = image;
        ++count;
    }
    return count;
}

static peak peak_given(const imp_value *spikes, size_t index)
{
    const double *at = spikes->number + 2 * index;
    return (peak){near_exact(at[0]), at[1], at[0], 0};
}

static imp_status spike_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    const imp_value *spikes = &values[SPIKES];
    const double width = values[WIDTH].number[0];
    size_t count = 0;
    for (size_t k = 0; k < spikes->extent[0]; ++k)
        count += repeat(peak_given(spikes, k), width, NULL);
    spike_instance *s = malloc(sizeof *s + count * sizeof s->peaks[0]);
    if (s == NULL) return IMP_STATUS_INTERNAL;
    s->radius = values[RADIUS].number[0];
    s->height = values[HEIGHT].number[0];
    s->steepness = near_of(imp_div(imp_num(1), imp_sqr(imp_num(width))));
    s->slope = imp_round_up(2 / width);
    s->left_out = (double)spikes->extent[0] * LEFT_OUT;
    imp_copy_vector(s->center, &values[CENTER]);
    s->count = 0;
    for (size_t k = 0; k < spikes->extent[0]; ++k)
        s->count += repeat(peak_given(spikes, k), width, s->peaks + s->count);
    *self = s;
    return IMP_STATUS_OK;
}

static void spike_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -IMP_HALF_PI_UPPER, IMP_HALF_PI_UPPER);
}

/* Beyond this (distance / width)^2 a peak is smaller than the rounding error. */
#define FAR 60
#define EXPONENT_MAX 690 /* exp neither underflows nor sets errno */

/* At most (distance / width)^2 from a peak to anything in the range of u and v. */
static double square_lower(const spike_instance *s, size_t k, const imp_model *u,
                           const imp_model *v)
{
    const near_constant top = s->peaks[k].u;
    double east = imp_larger(imp_sum_down(top.value - u->hi), imp_sum_down(u->lo - top.value));
    east = imp_sum_down(east - top.error);
    double north = imp_larger(s->peaks[k].v - v->hi, v->lo - s->peaks[k].v);
    east = imp_larger(east, 0), north = imp_larger(north, 0);
    return (east * east + north * north) * s->steepness.value * (1 - 0x1p-48);
}

static imp_model peak_near(const spike_instance *s, size_t k, imp_model u, imp_model v)
{
    const near_constant west = {-s->peaks[k].u.value, s->peaks[k].u.error};
    imp_model east = near_shift(u, west), north = imp_shift(v, -s->peaks[k].v);
    imp_model square = imp_add(imp_sqr(east), imp_sqr(north));
    return imp_exp(imp_neg(near_scale(square, s->steepness)));
}

/* All far peaks together; `rest` is their sum of exp(-3/4 square_lower), rounded up. Lemma: with
 * r^2 = square, a peak is exp(-r^2), and its slope at most 2/width r exp(-r^2); r exp(-r^2 / 4) <
 * 1. */
static imp_model peaks_far(const spike_instance *s, double rest, const imp_model *u,
                           const imp_model *v)
{
    imp_model sum = imp_between(0, rest);
    sum.depends = u->depends | v->depends;
    for (int j = 0; j < 3; ++j)
        sum.rate[j] = imp_round_up(s->slope * rest * (u->rate[j] + v->rate[j]) * (1 + 0x1p-48));
    return imp_model_finish(sum);
}

static imp_model radius_at(const spike_instance *s, imp_model u, imp_model v)
{
    imp_model sum = imp_num(0);
    double rest = s->left_out;
    for (size_t k = 0; k < s->count; ++k) {
        double square = square_lower(s, k, &u, &v);
        if (square > FAR)
            rest = imp_sum_up(rest + imp_libm_up(exp(-imp_smaller(0.75 * square, EXPONENT_MAX))));
        else
            sum = imp_add(sum, peak_near(s, k, u, v));
    }
    sum = imp_add(sum, peaks_far(s, rest, &u, &v));
    return imp_shift(imp_scale(sum, s->height), s->radius);
}

static void spike_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const spike_instance *s = self;
    imp_model sin_u, cos_u, sin_v, cos_v;
    (void)t;
    imp_sincos(u, &sin_u, &cos_u);
    imp_sincos(v, &sin_v, &cos_v);
    imp_model radius = radius_at(s, u, v), ring = imp_mul(radius, cos_v);
    out[0] = imp_shift(imp_mul(ring, cos_u), s->center[0]);
    out[1] = imp_shift(imp_mul(ring, sin_u), s->center[1]);
    out[2] = imp_shift(imp_mul(radius, sin_v), s->center[2]);
}
IMP_SURFACE_FORMULA(spike_formula)

/* exp(-((u - peak)^2 + (v - peak)^2)/width^2) */
static void write_peak(const peak *p, const imp_text_sink *to)
{
    imp_add_text(to, "exp(-((u - (");
    imp_add_number(to, p->given_u);
    imp_add_text(to, " + 2*pi*");
    imp_add_number(to, p->turn);
    imp_add_text(to, "))^2 + (v - ");
    imp_add_number(to, p->v);
    imp_add_text(to, ")^2)/width^2)");
}

static imp_status spike_write_formula(const void *self, const imp_text_sink *to)
{
    const spike_instance *s = self;
    imp_add_text(to, "r = radius + height*(0");
    for (size_t k = 0; k < s->count; ++k) {
        imp_add_text(to, " + ");
        write_peak(&s->peaks[k], to);
    }
    imp_add_text(to, "); u in [0, 2*pi]; v in [-pi/2, pi/2]; center0 + r*cos(v)*cos(u); "
                     "center1 + r*cos(v)*sin(u); center2 + r*sin(v)");
    return IMP_STATUS_OK;
}

static const imp_surface_type spike = {
    IMP_SURFACE_FIELDS(spike, spike_formula),
    .write_formula = spike_write_formula,
    .summary = "sphere with narrow spikes; near a pole, a spike makes the pole a line",
    .equation = "center + r(u,v) (cos v cos u, cos v sin u, sin v), r = radius + height sum_k "
                "exp(-((u-u_k)^2 + (v-v_k)^2) / width^2), summed over the turns of u_k that are "
                "within 26.7 widths of [0,2pi]",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, eqs. 8 and 9",
    .example = "spike radius=1 height=0.5 width=0.1 spikes=[[0,0],[3.14,0.5]]",
};

PUBLISH_SURFACE(spike);
