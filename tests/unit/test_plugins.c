/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <errno.h>
#include <impinge/model.h>
#include <string.h>

#include "tests/support/built_plugins.h"
#include "tests/support/instance.h"
#include "tests/support/judge.h"
#include "tests/support/sampling.h"
#include "tests/support/suite.h"

/* Every bound of every built type against its oracle, on seeded regions and points. */

enum { REGIONS = 60, POINTS = 6 };

enum { ERROR, REMAINDER, RATE, NET, POSE, KINDS };

/* Parts of the claimed bounds that are judged instead of the whole: 1 each in earnest, less to
 * see that a bound too low is found. */
typedef struct shares {
    double error, remainder, rate, net, pose;
} shares;

/* What is being tried, for the message when it fails. */
typedef struct trial {
    const instance *instance;
    int regions; /* to be tried */
    shares share;
    size_t refuted[KINDS]; /* with less than 1 */
    uint64_t random;
    const double *lo, *hi; /* of the region or box */
    int dimensions;
    double p[4], q[4];
    fault fault;
} trial;

static void describe_box(const trial *t, char *text, size_t size)
{
    int length = 0;
    for (int j = 0; j < t->dimensions; ++j)
        length += snprintf(text + length, size - (size_t)length, " [%a,%a] p %a q %a", t->lo[j],
                           t->hi[j], t->p[j], t->q[j]);
}

static void expect(trial *t, bool holds, int kind, const char *what)
{
    const double share[KINDS] = {t->share.error, t->share.remainder, t->share.rate, t->share.net,
                                 t->share.pose};
    char where[600] = "";
    t->refuted[kind] += !holds;
    if (holds || share[kind] < 1) return;
    if (t->lo != NULL) describe_box(t, where, sizeof where);
    ck_abort_msg("%s of %s %.300s: %s, at%s", what, t->instance->view.name, t->instance->text,
                 t->fault.text, where);
}

static void expect_status(const trial *t, imp_status status, const char *what)
{
    ck_assert_msg(status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED,
                  "%s of %s %.300s: status %d", what, t->instance->view.name, t->instance->text,
                  status);
}

static void exact(const instance *made, const double *p, int dimensions, number x[3])
{
    const type_oracle *row = oracles;
    number at[4];
    while (strcmp(row->type, made->view.name) != 0) ++row;
    for (int j = 0; j < dimensions; ++j) at[j] = num(p[j]);
    if (row->surface != NULL)
        row->surface(&made->arguments, at, x);
    else
        row->map(&made->arguments, at, x);
}

/* --- Properties of one surface ---------------------------------------------------------------- */

static void try_surface_point(trial *t)
{
    const instance *made = t->instance;
    double x[3], error[3];
    number truth[3];
    imp_status status = made->surface->eval(made->self, 1, t->p, x, error);
    ck_assert_msg(status == IMP_STATUS_OK, "eval of %s: status %d", made->view.name, status);
    exact(made, t->p, 3, truth);
    for (int i = 0; i < 3; ++i) error[i] *= t->share.error;
    expect(t, judge_point(x, error, truth, &t->fault), ERROR, "eval");
}

/* How far the coordinates at p and q are apart, against a rate matrix of n columns. */
static void try_change(trial *t, int n, const double *const rate[3], const number at_p[3],
                       const number at_q[3], const char *what)
{
    for (int i = 0; i < 3; ++i) {
        double lowered[4];
        for (int j = 0; j < n; ++j) lowered[j] = t->share.rate * rate[i][j];
        bool holds = judge_rates(n, lowered, t->p, t->q, at_p[i], at_q[i], &t->fault);
        expect(t, holds, RATE, what);
    }
}

static void try_rates(trial *t, int n, const double *const rate[3], const char *what)
{
    number at_p[3], at_q[3];
    sample_partner(&t->random, n, t->lo, t->hi, t->p, t->q);
    exact(t->instance, t->p, n, at_p);
    exact(t->instance, t->q, n, at_q);
    try_change(t, n, rate, at_p, at_q, what);
}

static void try_surface_region(trial *t, const imp_region *region)
{
    const instance *made = t->instance;
    imp_rate_matrix rates;
    imp_model model[3];
    errno = 0;
    expect_status(t, made->surface->rate(made->self, region, &rates), "rate");
    expect_status(t, made->surface->include(made->self, region, model), "include");
    ck_assert_msg(errno == 0, "%s sets errno", made->view.name);
    for (int i = 0; i < 3; ++i) model[i].e *= t->share.remainder;
    const double *const claimed[3] = {rates.m[0], rates.m[1], rates.m[2]};
    const double *const modelled[3] = {model[0].rate, model[1].rate, model[2].rate};
    for (int k = 0; k < POINTS; ++k) {
        number s[3], truth[3];
        num_forget();
        sample_point(&t->random, 3, region->lo, region->hi, t->p);
        try_surface_point(t);
        sample_normalized(region, t->p, s);
        exact(made, t->p, 3, truth);
        expect(t, judge_models(model, s, truth, &t->fault), REMAINDER, "include");
        try_rates(t, 3, claimed, "rate");
        try_rates(t, 3, modelled, "include's rate");
    }
}

static void try_surface_net(trial *t, const imp_region *region)
{
    const instance *made = t->instance;
    imp_net net = {.degree = {0, 0}};
    errno = 0;
    const imp_status status = made->surface->net(made->self, region, &net);
    expect_status(t, status, "net");
    ck_assert_msg(errno == 0, "%s sets errno", made->view.name);
    if (status != IMP_STATUS_OK) return;
    for (int i = 0; i < 3; ++i) net.error[i] *= t->share.net;
    for (int k = 0; k < POINTS; ++k) {
        number truth[3];
        num_forget();
        sample_point(&t->random, 3, region->lo, region->hi, t->p);
        exact(made, t->p, 3, truth);
        expect(t, judge_net(&net, region, t->p, truth, &t->fault), NET, "net");
    }
}

static void try_surface(trial *t)
{
    double lo[3], hi[3];
    t->instance->surface->domain(t->instance->self, lo, hi);
    t->dimensions = 3;
    for (int k = 0; k < t->regions; ++k) {
        imp_region region = sample_region(&t->random, lo, hi);
        t->lo = region.lo, t->hi = region.hi;
        try_surface_region(t, &region);
        if (t->instance->surface->net != NULL) try_surface_net(t, &region);
    }
}

/* --- Properties of one map -------------------------------------------------------------------- */

static void try_map_box(trial *t, const imp_box4 *box)
{
    const instance *made = t->instance;
    imp_map_rates rates;
    expect_status(t, made->map->rate(made->self, box, &rates), "rate");
    const double *const claimed[3] = {rates.m[0], rates.m[1], rates.m[2]};
    for (int k = 0; k < POINTS; ++k) {
        double x[3], error[3];
        number truth[3];
        num_forget();
        sample_point(&t->random, 4, box->lo, box->hi, t->p);
        ck_assert_int_eq(made->map->eval(made->self, 1, t->p, x, error), IMP_STATUS_OK);
        exact(made, t->p, 4, truth);
        for (int i = 0; i < 3; ++i) error[i] *= t->share.error;
        expect(t, judge_point(x, error, truth, &t->fault), ERROR, "eval");
        try_rates(t, 4, claimed, "rate");
    }
}

static void image(const instance *made, const sample_models *models, const double p[3], number x[3])
{
    const type_oracle *row = oracles;
    number at[4];
    while (strcmp(row->type, made->view.name) != 0) ++row;
    sample_value(models, p, at);
    row->map(&made->arguments, at, x);
}

static void try_map_models(trial *t, const sample_models *models)
{
    const instance *made = t->instance;
    imp_model out[3];
    errno = 0;
    expect_status(t, made->map->apply(made->self, models->in, out), "apply");
    ck_assert_msg(errno == 0, "%s sets errno", made->view.name);
    for (int i = 0; i < 3; ++i) out[i].e *= t->share.remainder;
    const double *const modelled[3] = {out[0].rate, out[1].rate, out[2].rate};
    for (int k = 0; k < POINTS; ++k) {
        number s[3], at_p[3], at_q[3];
        num_forget();
        sample_point(&t->random, 3, t->lo, t->hi, t->p);
        sample_partner(&t->random, 3, t->lo, t->hi, t->p, t->q);
        sample_normalized(&models->region, t->p, s);
        image(made, models, t->p, at_p);
        image(made, models, t->q, at_q);
        expect(t, judge_models(out, s, at_p, &t->fault), REMAINDER, "apply");
        try_change(t, 3, modelled, at_p, at_q, "apply's rate");
    }
}

/* The image of a random moving patch, weighted or not, against the net of its image. */
static void try_map_net(trial *t, const imp_region *region)
{
    const instance *made = t->instance;
    const type_oracle *row = oracles;
    imp_net given = {.degree = {(uint32_t)random_between(&t->random, 0, 3), 2},
                     .is_moving = (uint32_t)random_between(&t->random, 0, 2),
                     .is_weighted = (uint32_t)random_between(&t->random, 0, 2)};
    while (strcmp(row->type, made->view.name) != 0) ++row;
    for (int i = 0; i < 3; ++i) {
        given.place[i] = random_between(&t->random, -8, 8);
        given.drift[i] = random_between(&t->random, -8, 8);
        for (int k = 0; k < IMP_NET_POINTS; ++k) {
            given.point[i][k] = random_between(&t->random, -1, 1);
            given.velocity[i][k] = random_between(&t->random, -1, 1);
            given.weight[k] = random_between(&t->random, 0.25, 4);
        }
    }
    imp_net net = given;
    const imp_status status = made->map->net(made->self, region, &net);
    expect_status(t, status, "net");
    if (status != IMP_STATUS_OK) return;
    for (int i = 0; i < 3; ++i) net.error[i] *= t->share.net;
    for (int k = 0; k < POINTS; ++k) {
        number at[4], truth[3];
        num_forget();
        sample_point(&t->random, 3, region->lo, region->hi, t->p);
        net_value(&given, region, t->p, at);
        at[3] = num(t->p[2]);
        row->map(&made->arguments, at, truth);
        expect(t, judge_net(&net, region, t->p, truth, &t->fault), NET, "net");
    }
}

/* Column j of a pose at time t as the map's equation has it: the shift for j = 3, else how a point
 * at the distance 1 from the pivot is turned. */
static void exact_column(const instance *made, const imp_pose *pose, int j, double t, number x[3])
{
    const type_oracle *row = oracles;
    number at[4] = {num(pose->pivot[0]), num(pose->pivot[1]), num(pose->pivot[2]), num(t)}, y[3];
    while (strcmp(row->type, made->view.name) != 0) ++row;
    row->map(&made->arguments, at, x);
    if (j == 3) return;
    at[j] = num_add(at[j], num(1));
    row->map(&made->arguments, at, y);
    for (int i = 0; i < 3; ++i) x[i] = num_sub(y[i], x[i]);
}

static void try_map_pose(trial *t, const imp_region *region)
{
    const instance *made = t->instance;
    const imp_model time = region->d[2] > 0 ? imp_param(region, 2) : imp_num(region->c[2]);
    imp_pose pose;
    errno = 0;
    memset(&pose, 0, sizeof pose);
    const imp_status status = made->map->rigid(made->self, &time, &pose);
    expect_status(t, status, "rigid");
    ck_assert_msg(errno == 0, "%s sets errno", made->view.name);
    if (status != IMP_STATUS_OK) return;
    for (int k = 0; k < POINTS; ++k) {
        sample_point(&t->random, 3, region->lo, region->hi, t->p);
        sample_point(&t->random, 3, region->lo, region->hi, t->q);
        memcpy(t->q, t->p, 2 * sizeof *t->q);
        for (int j = 0; j < 4; ++j) {
            number s[3], at_p[3], at_q[3];
            imp_model column[3];
            num_forget();
            sample_normalized(region, t->p, s);
            exact_column(made, &pose, j, t->p[2], at_p);
            exact_column(made, &pose, j, t->q[2], at_q);
            for (int i = 0; i < 3; ++i) {
                column[i] = j < 3 ? pose.turn[i][j] : pose.shift[i];
                column[i].e *= t->share.pose;
            }
            const double *const rates[3] = {column[0].rate, column[1].rate, column[2].rate};
            expect(t, judge_models(column, s, at_p, &t->fault), POSE, "pose");
            try_change(t, 3, rates, at_p, at_q, "pose's rate");
        }
    }
}

/* Poses alone. */
static void try_poses(trial *t)
{
    double t_lo, t_hi;
    if (t->instance->map->rigid == NULL) return;
    t->instance->map->time_domain(t->instance->self, &t_lo, &t_hi);
    for (int k = 0; k < t->regions; ++k) {
        const sample_models models = sample_map_arguments(&t->random, t_lo, t_hi);
        t->dimensions = 3;
        t->lo = models.region.lo, t->hi = models.region.hi;
        try_map_pose(t, &models.region);
    }
}

static void try_map(trial *t)
{
    double t_lo, t_hi;
    t->instance->map->time_domain(t->instance->self, &t_lo, &t_hi);
    for (int k = 0; k < t->regions; ++k) {
        imp_box4 box = sample_box(&t->random, t_lo, t_hi);
        t->dimensions = 4;
        t->lo = box.lo, t->hi = box.hi;
        try_map_box(t, &box);
        sample_models models = sample_map_arguments(&t->random, t_lo, t_hi);
        t->dimensions = 3;
        t->lo = models.region.lo, t->hi = models.region.hi;
        try_map_models(t, &models);
        if (t->instance->map->net != NULL) try_map_net(t, &models.region);
        if (t->instance->map->rigid != NULL) try_map_pose(t, &models.region);
    }
}

/* --- Tests ------------------------------------------------------------------------------------ */

static const shares whole = {1, 1, 1, 1, 1};

/* What of a type was to be refuted and was not yet; NULL: enough. */
typedef const char *(*missing_kind)(const type_oracle *row, const size_t refuted[KINDS]);

static void for_each_of(imp_registry *registry, const type_oracle *row, void (*try)(trial *t),
                        trial plan, size_t refuted[KINDS])
{
    for (size_t i = 0; row->instances[i] != NULL; ++i) {
        uint64_t random = plan.random + 1000 * i;
        instance made = instance_make(registry, row->type, row->instances[i], &random);
        trial t = {
            .instance = &made, .regions = plan.regions, .share = plan.share, .random = random};
        try(&t);
        for (int kind = 0; kind < KINDS; ++kind) refuted[kind] += t.refuted[kind];
        instance_free(&made);
    }
}

/* With `missing`, regions are drawn until it misses nothing, ten times as many as usual at most. */
static void for_each_instance(bool surfaces, void (*try)(trial *t), shares share,
                              missing_kind missing)
{
    enum { ROUNDS = 100 };
    imp_registry *registry = built_registry();
    trial plan = {.share = share};
    for (const type_oracle *row = oracles; row < oracles + oracle_count; ++row) {
        size_t refuted[KINDS] = {0};
        const char *still = NULL;
        if ((row->surface != NULL) != surfaces) continue;
        plan.random = suite_seed();
        plan.regions = missing != NULL ? REGIONS / 10 : suite_times(REGIONS);
        for (int round = 0; round == 0 || (still != NULL && round < ROUNDS); ++round) {
            for_each_of(registry, row, try, plan, refuted);
            if (missing != NULL) still = missing(row, refuted);
            plan.random += 1000000;
        }
        ck_assert_msg(still == NULL, "%s: no %s was refuted", row->type, still);
    }
    imp_registry_free(registry);
}

START_TEST(every_point_model_and_rate_of_a_surface_holds_against_its_formula)
{
    for_each_instance(true, try_surface, whole, NULL);
}
END_TEST

START_TEST(every_point_model_and_rate_of_a_map_holds_against_its_formula)
{
    for_each_instance(false, try_map, whole, NULL);
}
END_TEST

static bool is_listed(const type_oracle *row, const char *const *names)
{
    while (*names != NULL && strcmp(row->type, *names) != 0) ++names;
    return *names != NULL;
}

/* Types whose points are not rounded: a bound of 0 cannot be too low. */
static const char *const unrounded[] = {"tolerance", NULL};

static const char *missing_bound(const type_oracle *row, const size_t refuted[KINDS])
{
    return !refuted[ERROR] && !is_listed(row, unrounded) ? "error"
           : !refuted[REMAINDER]                         ? "remainder"
           : !refuted[RATE]                              ? "rate"
                                                         : NULL;
}

/* These tests must be able to fail: for every type they find what is too low. */
START_TEST(bounds_that_are_too_low_are_found)
{
    const shares low = {0.01, 0.5, 0.9, 1, 1};
    for_each_instance(true, try_surface, low, missing_bound);
    for_each_instance(false, try_map, low, missing_bound);
}
END_TEST

static size_t rows_listed(const char *const *names)
{
    size_t count = 0;
    for (size_t k = 0; k < oracle_count; ++k) count += is_listed(&oracles[k], names);
    return count;
}

static const char *const with_nets[] = {"bezier", "bezier-triangle", "box",         "nurbs",
                                        "point",  "segment",         "subdivision", "triangle",
                                        "plane",  "translate",       NULL};

static const char *missing_net(const type_oracle *row, const size_t refuted[KINDS])
{
    return is_listed(row, with_nets) && !refuted[NET] ? "net" : NULL;
}

START_TEST(nets_without_their_errors_are_found)
{
    const shares low = {1, 1, 1, 0, 1};
    for_each_instance(true, try_surface, low, missing_net);
    for_each_instance(false, try_map, low, missing_net);
    ck_assert_uint_eq(rows_listed(with_nets), 11); /* subdivision has two rows */
}
END_TEST

static const char *const rigid[] = {"rotate",     "screw",          "translate", "keyframes",
                                    "trajectory", "motion-formula", NULL};

static const char *missing_pose(const type_oracle *row, const size_t refuted[KINDS])
{
    return is_listed(row, rigid) && !refuted[POSE] ? "pose" : NULL;
}

START_TEST(poses_without_their_remainders_are_found)
{
    const shares low = {1, 1, 1, 1, 0};
    for_each_instance(false, try_poses, low, missing_pose);
    ck_assert_uint_eq(rows_listed(rigid), 6);
}
END_TEST

START_TEST(every_built_type_has_an_oracle)
{
    imp_registry *registry = built_registry();
    imp_type_info info;
    for (size_t i = 0; imp_registry_type(registry, i, &info); ++i) {
        bool known = false;
        for (size_t k = 0; k < oracle_count; ++k)
            known = known || strcmp(oracles[k].type, info.name) == 0;
        ck_assert_msg(known, "%s has no row in type_oracle.c", info.name);
    }
    imp_registry_free(registry);
}
END_TEST

/* The times from -late to late, as far as they are within lo and hi. False: none. */
static bool take_late_times(double late, imp_region *region, double lo[3], double hi[3])
{
    lo[2] = imp_larger(lo[2], -late);
    hi[2] = imp_smaller(hi[2], late);
    if (!(lo[2] <= hi[2])) return false;
    *region = region_make(lo, hi);
    return true;
}

/* Where there are no bounds the models say so: what was in them before is no bound. */
static void try_late(trial *t)
{
    const instance *made = t->instance;
    for (double late = 1; late <= 1e300; late *= 1e13) {
        double lo[3] = {0, 0, 0}, hi[3] = {0, 0, 0};
        imp_region region;
        imp_model model[3] = {{.e = -1}, {.e = -1}, {.e = -1}};
        if (made->surface != NULL)
            made->surface->domain(made->self, lo, hi);
        else
            made->map->time_domain(made->self, &lo[2], &hi[2]);
        if (!take_late_times(late, &region, lo, hi)) continue;
        const imp_model in[4] = {imp_num(1), imp_num(2), imp_num(3), imp_param(&region, 2)};
        expect_status(t,
                      made->surface != NULL ? made->surface->include(made->self, &region, model)
                                            : made->map->apply(made->self, in, model),
                      "late times");
        for (int i = 0; i < 3; ++i)
            ck_assert_msg(model[i].e >= 0 && model[i].lo <= model[i].hi,
                          "%s %.300s over t [%g, %g]: coordinate %d was not set", made->view.name,
                          made->text, region.lo[2], region.hi[2], i);
    }
}

START_TEST(models_are_set_where_times_are_too_late_for_bounds)
{
    for_each_instance(true, try_late, whole, NULL);
    for_each_instance(false, try_late, whole, NULL);
}
END_TEST

/* Many points at once are what each is alone, and errors may be left out. */
static void try_batch(trial *t)
{
    enum { N = 17 };
    const imp_surface_type *type = t->instance->surface;
    double lo[3], hi[3], p[3 * N], x[3 * N], alone[3], error[3 * N];
    type->domain(t->instance->self, lo, hi);
    lo[2] = -1, hi[2] = 1;
    for (int k = 0; k < N; ++k) sample_point(&t->random, 3, lo, hi, p + 3 * k);
    ck_assert_int_eq(type->eval(t->instance->self, N, p, x, error), IMP_STATUS_OK);
    for (int k = 0; k < N; ++k) {
        ck_assert_int_eq(type->eval(t->instance->self, 1, p + 3 * k, alone, NULL), IMP_STATUS_OK);
        ck_assert_mem_eq(alone, x + 3 * k, sizeof alone);
    }
}

START_TEST(a_batch_of_points_is_the_points_one_by_one)
{
    for_each_instance(true, try_batch, whole, NULL);
}
END_TEST

SUITE_MAIN("plugins", every_built_type_has_an_oracle,
           every_point_model_and_rate_of_a_surface_holds_against_its_formula,
           every_point_model_and_rate_of_a_map_holds_against_its_formula,
           bounds_that_are_too_low_are_found, nets_without_their_errors_are_found,
           poses_without_their_remainders_are_found,
           models_are_set_where_times_are_too_late_for_bounds,
           a_batch_of_points_is_the_points_one_by_one)
