/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "near.h"
#include "plugin.h"

#include <impinge/formula.h>

/* A sphere with narrow peaks (paper, eqs. 8 and 9): what sampling misses and bounds do not. A
 * peak repeats with every turn in longitude, so that the surface closes at its seam. */

enum { RADIUS, HEIGHT, WIDTH, SPIKES, CENTER };

#define WIDTH_MAX 3.141592653589793 /* wider, and dozens of turns would count */

static const imp_parameter parameters[] = {
    [RADIUS] = ROW_POSITIVE("radius", "length", "1", "of the sphere"),
    [HEIGHT] = ROW_NUMBER("height", "length", "1", "of a spike; negative: a dent"),
    [WIDTH] = {.name = "width",
               .unit = "rad",
               .doc = "how far from its top a spike has fallen to 1/e of its height",
               .preset = "0.2",
               .kind = IMP_NUMBER,
               .min = 1e-100,
               .max = WIDTH_MAX},
    [SPIKES] = {.name = "spikes",
                .unit = "rad",
                .doc = "[longitude, latitude] of each spike",
                .preset = "[[0,0]]",
                .kind = IMP_NUMBER,
                .rank = 2,
                .extent = {0, 2},
                .min = -100,
                .max = 100},
    [CENTER] = ROW_CENTER,
};

typedef struct peak {
    double u, v;
} peak;

typedef struct spike_instance {
    double radius, height, center[3];
    near_constant steepness; /* 1 / width^2 */
    double slope;            /* at least 2 / width */
    size_t count;
    peak peaks[]; /* with their repetitions */
} spike_instance;

/* The double nearest to 2 pi: a peak's repetition is off by less than 4e-15. */
#define TURN 0x1.921fb54442d18p+2
#define TURNS_MAX 40 /* beyond the reach of the widest at +-100 rad */

/* exp(-26.7^2) < 2^-1022: where a peak falls below that all over the domain, it is left out. */
static bool is_in_reach(double u, double width)
{
    double distance = u < 0 ? -u : u > ABOVE_TWO_PI ? u - ABOVE_TWO_PI : 0;
    return distance <= 26.7 * width;
}

/* Writes the peak's repetitions to `to` unless it is NULL; answers how many they are. */
static size_t repeat(peak top, double width, peak *to)
{
    size_t count = 0;
    for (int turn = -TURNS_MAX; turn <= TURNS_MAX; ++turn) {
        peak image = {top.u + turn * TURN, top.v};
        if (!is_in_reach(image.u, width)) continue;
        if (to) to[count] = image;
        ++count;
    }
    return count;
}

static peak peak_given(const imp_value *spikes, size_t index)
{
    return (peak){spikes->number[2 * index], spikes->number[2 * index + 1]};
}

static imp_status spike_create(const imp_value *values, void **self, imp_complaint *why)
{
    (void)why;
    const imp_value *spikes = &values[SPIKES];
    const double width = values[WIDTH].number[0];
    size_t count = 0;
    for (size_t k = 0; k < spikes->extent[0]; ++k)
        count += repeat(peak_given(spikes, k), width, NULL);
    spike_instance *s = malloc(sizeof *s + count * sizeof s->peaks[0]);
    if (!s) return IMP_INTERNAL;
    s->radius = values[RADIUS].number[0];
    s->height = values[HEIGHT].number[0];
    s->steepness = near_of(imp_div(imp_num(1), imp_sqr(imp_num(width))));
    s->slope = imp_round_up(2 / width);
    copy_vector(s->center, &values[CENTER]);
    s->count = 0;
    for (size_t k = 0; k < spikes->extent[0]; ++k)
        s->count += repeat(peak_given(spikes, k), width, s->peaks + s->count);
    *self = s;
    return IMP_OK;
}

static void spike_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    set_domain(lo, hi, 0, ABOVE_TWO_PI, -ABOVE_HALF_PI, ABOVE_HALF_PI);
}

/* Beyond this (distance / width)^2 a peak counts for less than rounding does. */
#define FAR 60
#define EXPONENT_MAX 690 /* exp does not underflow, nor touch errno */

/* At most (distance / width)^2 from a peak to anything in the range of u and v. */
static double square_lower(const spike_instance *s, size_t k, const imp_model *u,
                           const imp_model *v)
{
    double east = imp_larger(s->peaks[k].u - u->hi, u->lo - s->peaks[k].u);
    double north = imp_larger(s->peaks[k].v - v->hi, v->lo - s->peaks[k].v);
    east = imp_larger(east, 0), north = imp_larger(north, 0);
    return (east * east + north * north) * s->steepness.value * (1 - 0x1p-48);
}

static imp_model peak_near(const spike_instance *s, size_t k, imp_model u, imp_model v)
{
    imp_model east = imp_shift(u, -s->peaks[k].u), north = imp_shift(v, -s->peaks[k].v);
    imp_model square = imp_add(imp_sqr(east), imp_sqr(north));
    return imp_exp(imp_neg(near_scale(square, s->steepness)));
}

/* All far peaks together, `rest` being their sum of exp(-3/4 square_lower), rounded up. Lemma: with
 * r^2 = square, a peak is exp(-r^2), and its slope at most 2/width r exp(-r^2); r exp(-r^2 / 4)
 * < 1. */
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
    double rest = 0;
    for (size_t k = 0; k < s->count; ++k) {
        double square = square_lower(s, k, &u, &v);
        if (square > FAR)
            rest = imp_sum_up(rest + imp_libm_up(exp(-imp_smaller(0.75 * square, EXPONENT_MAX))));
        else
            sum = imp_add(sum, peak_near(s, k, u, v));
    }
    if (rest > 0) sum = imp_add(sum, peaks_far(s, rest, &u, &v));
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

static const imp_surface_type spike = {
    SURFACE_CALLS(spike, spike_formula),
    .summary = "sphere with narrow spikes; near a pole, a spike makes the pole a line",
    .equation = "center + r(u,v) (cos v cos u, cos v sin u, sin v), r = radius + height sum_k "
                "exp(-((u-u_k)^2 + (v-v_k)^2) / width^2), summed over all turns of u_k",
    .source = "Von Herzen, Barr, Zatz, SIGGRAPH 1990, eqs. 8 and 9",
    .example = "spike radius=1 height=0.5 width=0.1 spikes=[[0,0],[3.14,0.5]]",
};

PUBLISH_SURFACE(spike);
