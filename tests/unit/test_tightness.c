/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/unconst.h"
#include "core/surface/region.h"
#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/model_value.h"

/* Bounds that hold may still be useless. Here they are compared with what they bound, on a
 * grid over regions of many sizes: ratios of e to the greatest distance seen from the quadratic, of
 * widths of ranges, and of rates to the steepest slope found. */

enum { GRID = 9, REGIONS = 40 };

typedef struct ratios {
    double remainder, range, rate; /* sums of logarithms */
    int remainders, ranges, rates; /* how many */
} ratios;

typedef struct seen {
    double off[3], lo[3], hi[3], slope[3][3];
} seen;

static void point_at(const imp_region *region, const double s[3], double p[3])
{
    for (int j = 0; j < 3; ++j) {
        p[j] = region->c[j] + region->d[j] * s[j];
        if (p[j] < region->lo[j]) p[j] = region->lo[j];
        if (p[j] > region->hi[j]) p[j] = region->hi[j];
    }
}

static void look(const instance *made, const imp_region *region, const imp_model model[3],
                 const double s[3], seen *found)
{
    double p[3], x[3], beside[3];
    point_at(region, s, p);
    ck_assert_int_eq(made->surface->eval(made->self, 1, p, x, NULL), IMP_STATUS_OK);
    for (int i = 0; i < 3; ++i) {
        found->off[i] = fmax(found->off[i], fabs(x[i] - quadratic_at(&model[i], s)));
        found->lo[i] = fmin(found->lo[i], x[i]);
        found->hi[i] = fmax(found->hi[i], x[i]);
    }
    for (int j = 0; j < 3; ++j) {
        double q[3] = {p[0], p[1], p[2]};
        double step = 1e-3 * region->d[j] * (s[j] > 0 ? -1 : 1);
        q[j] += step;
        made->surface->eval(made->self, 1, q, beside, NULL);
        for (int i = 0; i < 3; ++i)
            found->slope[i][j] = fmax(found->slope[i][j], fabs((beside[i] - x[i]) / step));
    }
}

static void count(double bound, double truth, double floor, double *sum, int *counted)
{
    if (truth < floor) return;
    *sum += log2(bound / truth);
    ++*counted;
}

static void measure(const instance *made, const imp_region *region, ratios *sums)
{
    imp_model model[3];
    imp_rate_matrix rates;
    seen found = {.lo = {INFINITY, INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY, -INFINITY}};
    ck_assert_int_eq(made->surface->include(made->self, region, model), IMP_STATUS_OK);
    ck_assert_int_eq(made->surface->rate(made->self, region, &rates), IMP_STATUS_OK);
    for (int k = 0; k < GRID * GRID * GRID; ++k) {
        const int at[3] = {k % GRID, k / GRID % GRID, k / GRID / GRID};
        double s[3];
        for (int j = 0; j < 3; ++j) s[j] = 2.0 * at[j] / (GRID - 1) - 1;
        look(made, region, model, s, &found);
    }
    for (int i = 0; i < 3; ++i) {
        count(model[i].e, found.off[i], 1e-11, &sums->remainder, &sums->remainders);
        count(model[i].hi - model[i].lo, found.hi[i] - found.lo[i], 1e-11, &sums->range,
              &sums->ranges);
        for (int j = 0; j < 3; ++j)
            count(rates.m[i][j], found.slope[i][j], 1e-3, &sums->rate, &sums->rates);
    }
}

static imp_region draw_region(uint64_t *random, const instance *made)
{
    double lo[3], hi[3];
    made->surface->domain(made->self, lo, hi);
    lo[2] = fmax(lo[2], 0), hi[2] = fmin(hi[2], 1);
    for (int j = 0; j < 3; ++j) {
        double width = (hi[j] - lo[j]) * random_power(random, -6, 0);
        lo[j] = random_between(random, lo[j], hi[j] - width);
        hi[j] = lo[j] + width;
    }
    return region_make(lo, hi);
}

/* One of its pieces, if it has any. */
static instance draw_piece(uint64_t *random, const instance *made)
{
    instance part = *made;
    if (made->surface->piece_count == NULL) return part;
    const size_t count = made->surface->piece_count(made->self);
    part.self = unconst(made->surface->piece(made->self, random_bits(random) % count));
    return part;
}

/* The geometric mean; what is flat has no remainder to compare with. */
static double mean(double sum, int counted) { return counted > 0 ? exp2(sum / counted) : 1; }

/* Geometric means over regions, and what they may be: about a tenth more than they are. */
static const struct limit {
    const char *type, *instance;
    double remainder, range, rate;
} limits[] = {
    {"bezier", "{\"degree\": [3,3], \"points\": [@16[?,?,?]]}", 1.25, 1.25, 1.1},
    {"bezier", "{\"degree\": [3,3], \"points\": [@16[?,?,?]], \"velocities\": [@16[?,?,?]]}", 1.3,
     1.3, 1.1},
    {"bezier", "{\"degree\": [6,2], \"points\": [@21[?,?,?]]}", 1.25, 1.25, 1.1},
    {"bezier", "{\"degree\": [2,3], \"points\": [@12[?,?,?]], \"weights\": [@12+]}", 2.6, 1.3, 1.6},
    {"bezier-triangle", "{\"degree\": 3, \"points\": [@10[?,?,?]], \"velocities\": [@10[?,?,?]]}",
     1.3, 1.3, 1.1},
    {"bezier-triangle", "{\"degree\": 2, \"points\": [@6[?,?,?]], \"weights\": [@6+]}", 2.6, 1.3,
     1.6},
    {"sphere", "{}", 1.3, 1.1, 1.1},
    {"torus", "{}", 1.5, 1.1, 1.1},
    {"ellipsoid", "{}", 1.3, 1.1, 1.1},
    {"cylinder", "{}", 1.3, 1.1, 1.1},
    {"cone", "{}", 1.3, 1.1, 1.1},
    {"disc", "{}", 1.3, 1.1, 1.1},
    {"disc", "{\"axis\": [?,?,?]}", 1.5, 1.2, 1.3},
    {"extrusion", "{\"degree\": 3, \"profile\": [@7[?,?]], \"vector\": [?,?,1]}", 1.3, 1.2, 1.2},
    {"triangle", "{\"points\": [@3[?,?,?]], \"velocities\": [@3[?,?,?]]}", 1.01, 1.01, 1.01},
    {"thread", "{}", 1.6, 1.2, 1.2},
    {"thread", "{\"profile\": [0.1,0.05], \"starts\": 2}", 1.65, 1.2, 1.4},
    {"ripple", "{}", 1.4, 1.1, 1.1},
    {"superellipsoid", "{}", 1.9, 1.2, 1.6},
    {"superellipsoid", "{\"exponents\": [0.3,1.5]}", 1.7, 1.25, 1.7},
    {"superellipsoid", "{\"exponents\": [0.05,2]}", 1.4, 1.3, 1.6},
    {"supertoroid", "{}", 1.7, 1.2, 1.7},
    {"revolution", "{}", 1.5, 1.55, 1.5},
    {"sweep", "{\"profile\": [@4[?,?,?]]}", 1.2, 1.2, 1.1},
    {"product", "{}", 1.3, 1.7, 1.75},
    {"nurbs", "{}", 1.2, 1.15, 1.15},
    {"nurbs",
     "{\"degree\": [3,3], \"knots\": [@2[0,0,0,0,1,2,3,4,4,4,4]], \"points\": [@49[?,?,?]],"
     " \"velocities\": [@49[?,?,?]]}",
     1.3, 1.25, 1.35},
    {"nurbs", "{\"points\": [@16[?,?,?]], \"weights\": [@16+]}", 2.6, 1.6, 2.2},
    {"subdivision",
     "{\"points\": [@16[?,?,?]], \"velocities\": [@16[?,?,?]],"
     " \"faces\": [[5,9,10,6],[0,4,5,1],[1,5,6,2],[2,6,7,3],[4,8,9,5],[6,10,11,7],[8,12,13,9],"
     "[9,13,14,10],[10,14,15,11]]}",
     1.3, 1.3, 1.1},
    {"subdivision",
     "{\"points\": [@11[?,?,?]],"
     " \"faces\": [[0,1,2,3],[0,3,4,5],[0,5,6,7],[0,7,8,9],[0,9,10,1]]}",
     1.3, 1.3, 1.1},
    {"spike", "{\"spikes\": [@2[?,?]], \"width\": 0.5}", 2, 1.4, 4},
};

/* Types that are a whole body, of which any piece counts; of those above, the first. */
static const struct limit whole[] = {
    {"cylinder", "{\"ends\": true}", 1.3, 1.1, 1.1},
    {"cone", "{\"ends\": true}", 1.3, 1.1, 1.1},
    {"box", "{\"size\": [+,+,+]}", 1.01, 1.01, 1.01},
    {"capsule", "{}", 1.3, 1.1, 1.1},
    {"capsule", "{\"from\": [?,?,?], \"to\": [?,?,?]}", 1.5, 1.2, 1.35},
    {"extrusion", "{\"ends\": true}", 1.2, 1.25, 1.3},
};

static void hold(const struct limit *limit, bool any_piece)
{
    imp_registry *registry = built_registry();
    uint64_t random = suite_seed();
    ratios sum = {0};
    for (int r = 0; r < REGIONS; ++r) {
        instance made = instance_make(registry, limit->type, limit->instance, &random);
        const instance part = any_piece ? draw_piece(&random, &made) : made;
        const imp_region region = draw_region(&random, &part);
        measure(&part, &region, &sum);
        instance_free(&made);
    }
    const double remainder = mean(sum.remainder, sum.remainders);
    const double range = mean(sum.range, sum.ranges), rate = mean(sum.rate, sum.rates);
    ck_assert_msg(remainder < limit->remainder && range < limit->range && rate < limit->rate,
                  "%s %s: remainder %g times too wide, range %g, rate %g", limit->type,
                  limit->instance, remainder, range, rate);
    imp_registry_free(registry);
}

START_TEST(bounds_are_not_much_wider_than_what_they_bound)
{
    for (size_t k = 0; k < sizeof limits / sizeof limits[0]; ++k) hold(&limits[k], false);
    for (size_t k = 0; k < sizeof whole / sizeof whole[0]; ++k) hold(&whole[k], true);
}
END_TEST

SUITE_MAIN("tightness", bounds_are_not_much_wider_than_what_they_bound)
