/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/surface.h"
#include "tests/support/built_plugins.h"
#include "tests/support/compose.h"
#include "tests/support/instance.h"
#include "tests/support/judge.h"
#include "tests/support/sampling.h"
#include "tests/support/suite.h"

/* Random surfaces under two or three random maps: points, rates and models of the composition
 * against the oracles of its parts, one applied to the other in numbers of 200 bits. Only types
 * that the build directory has are drawn, so that a few, compiled otherwise, can be tried alone. */

enum { PARTS = 4, REGIONS = 5, POINTS = 3 };

typedef struct part {
    const type_oracle *row;
    instance made;
    imp_surface_type surface; /* copies that leave the instance to instance_free */
    imp_map_type map;
} part;

typedef struct chain {
    uint64_t random;
    int count;
    part part[PARTS]; /* the surface, then its maps from the inside */
    surface *composed;
    double lowered; /* 1, or less to see that bounds too low are found */
    size_t judged, refuted;
    fault fault;
} chain;

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }

static void close_registry(void) { imp_registry_free(registry); }

/* --- Composing -------------------------------------------------------------------------------- */

static void keep(void *self) { (void)self; }

static bool is_built(const type_oracle *row)
{
    return row->surface != NULL ? registry_find_surface(registry, row->type) != NULL
                                : registry_find_map(registry, row->type) != NULL;
}

static const type_oracle *draw_row(uint64_t *random, bool base)
{
    for (;;) {
        const type_oracle *row = &oracles[random_bits(random) % oracle_count];
        if ((row->surface != NULL) == base && is_built(row)) return row;
    }
}

static void draw_part(part *p, uint64_t *random, bool base)
{
    size_t count = 0;
    p->row = draw_row(random, base);
    while (p->row->instances[count] != NULL) ++count;
    const char *template = p->row->instances[random_bits(random) % count];
    p->made = instance_make(registry, p->row->type, template, random);
}

static void add_map(chain *c, part *p)
{
    p->map = *p->made.map;
    p->map.destroy = keep;
    ck_assert_int_eq(surface_add_map(c->composed, &p->map, p->made.self), IMP_SUCCESS);
}

static void compose(chain *c)
{
    c->count = 3 + (int)(random_bits(&c->random) % 2);
    for (int k = 0; k < c->count; ++k) draw_part(&c->part[k], &c->random, k == 0);
    c->part[0].surface = *c->part[0].made.surface;
    c->part[0].surface.destroy = keep;
    c->composed = surface_new(&c->part[0].surface, c->part[0].made.self);
    ck_assert_ptr_nonnull(c->composed);
    for (int k = 1; k < c->count; ++k) add_map(c, &c->part[k]);
}

static void take_apart(chain *c)
{
    surface_free(c->composed);
    for (int k = 0; k < c->count; ++k) instance_free(&c->part[k].made);
}

/* --- Judging ---------------------------------------------------------------------------------- */

static void exact(const chain *c, const double p[3], number x[3])
{
    const number at[3] = {num(p[0]), num(p[1]), num(p[2])};
    c->part[0].row->surface(&c->part[0].made.arguments, at, x);
    for (int k = 1; k < c->count; ++k) {
        const number in[4] = {x[0], x[1], x[2], at[2]};
        c->part[k].row->map(&c->part[k].made.arguments, in, x);
    }
}

static void expect(chain *c, bool holds, const char *what, const double p[3], const double q[3])
{
    ++c->judged;
    c->refuted += !holds;
    if (holds || c->lowered < 1) return;
    char text[3000] = "";
    for (int k = 0, length = 0; k < c->count && length < 2500; ++k)
        length += snprintf(text + length, sizeof text - (size_t)length, "%s %.300s ! ",
                           c->part[k].row->type, c->part[k].made.text);
    ck_abort_msg("%s of %s: %s, at p %a,%a,%a q %a,%a,%a", what, text, c->fault.text, p[0], p[1],
                 p[2], q[0], q[1], q[2]);
}

static void try_point(chain *c, const double p[3], const number truth[3])
{
    double x[3], error[3];
    if (surface_eval(c->composed, 1, p, x, error) != IMP_STATUS_OK) return;
    for (int i = 0; i < 3; ++i) {
        if (isinf(error[i])) return; /* rates overflow: nothing is claimed */
        error[i] *= c->lowered;
    }
    expect(c, judge_point(x, error, truth, &c->fault), "eval", p, p);
}

static void try_rates(chain *c, const double *const rate[3], const double p[3], const double q[3],
                      const number at_p[3], const number at_q[3])
{
    for (int i = 0; i < 3; ++i) {
        double lowered[3];
        for (int j = 0; j < 3; ++j) lowered[j] = c->lowered * rate[i][j];
        expect(c, judge_rates(3, lowered, p, q, at_p[i], at_q[i], &c->fault), "rate", p, q);
    }
}

/* Bounds that the composition has over the region. */
typedef struct bounds {
    imp_rate_matrix rates;
    imp_model model[3];
    bool has_rates, has_models;
} bounds;

static bounds bounds_over(const chain *c, const imp_region *region)
{
    bounds b;
    b.has_rates = surface_rate(c->composed, region, &b.rates) == IMP_STATUS_OK;
    b.has_models = surface_include(c->composed, region, b.model) == IMP_STATUS_OK;
    for (int i = 0; b.has_models && i < 3; ++i) b.model[i].e *= c->lowered;
    return b;
}

static void try_pair(chain *c, const imp_region *region, const bounds *b)
{
    double p[3], q[3];
    number s[3], at_p[3], at_q[3];
    num_forget();
    sample_point(&c->random, 3, region->lo, region->hi, p);
    sample_partner(&c->random, 3, region->lo, region->hi, p, q);
    exact(c, p, at_p);
    exact(c, q, at_q);
    try_point(c, p, at_p);
    if (b->has_rates)
        try_rates(c, (const double *[3]){b->rates.m[0], b->rates.m[1], b->rates.m[2]}, p, q, at_p,
                  at_q);
    if (!b->has_models) return;
    const double *const modelled[3] = {b->model[0].rate, b->model[1].rate, b->model[2].rate};
    try_rates(c, modelled, p, q, at_p, at_q);
    sample_normalized(region, p, s);
    expect(c, judge_models(b->model, s, at_p, &c->fault), "include", p, p);
}

static void try_regions(chain *c)
{
    double lo[3], hi[3];
    surface_domain(c->composed, lo, hi);
    for (int k = 0; lo[2] <= hi[2] && k < REGIONS; ++k) {
        const imp_region region = sample_region(&c->random, lo, hi);
        const bounds b = bounds_over(c, &region);
        for (int n = 0; n < POINTS; ++n) try_pair(c, &region, &b);
    }
}

/* Tries many chains, and counts what was judged and what was refuted. */
static void try_chains(double lowered, size_t *judged, size_t *refuted)
{
    *judged = *refuted = 0;
    for (int k = 0; k < suite_times(400); ++k) {
        chain c = {.random = suite_seed() + 7919 * (uint64_t)k, .lowered = lowered};
        compose(&c);
        try_regions(&c);
        take_apart(&c);
        *judged += c.judged;
        *refuted += c.refuted;
    }
}

START_TEST(points_rates_and_models_of_nested_maps_hold_against_their_formulas)
{
    size_t judged, refuted;
    try_chains(1, &judged, &refuted);
    ck_assert_uint_eq(refuted, 0);
    ck_assert_uint_ge(judged, (size_t)suite_times(400) * REGIONS * POINTS * 4);
}
END_TEST

START_TEST(bounds_of_nested_maps_that_are_too_low_are_found)
{
    size_t judged, refuted;
    try_chains(0.05, &judged, &refuted);
    ck_assert_uint_ge(refuted, judged / 50);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {
        points_rates_and_models_of_nested_maps_hold_against_their_formulas,
        bounds_of_nested_maps_that_are_too_low_are_found};
    return suite_main_with("nested maps", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
