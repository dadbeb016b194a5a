/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* A map, (x + sin 2y, y, z cos(rate t)), all in order, and types that make one mistake each. */

static const imp_parameter table[] = {{.name = "rate",
                                       .unit = "rad/time",
                                       .doc = "how fast z swings",
                                       .default_value = "1",
                                       .kind = IMP_KIND_NUMBER,
                                       .min = -100,
                                       .max = 100}};

static imp_status skew_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    double *made = malloc(sizeof *made);
    if (made == NULL) return IMP_STATUS_INTERNAL;
    *made = values[0].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static void skew(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                 imp_model out[3])
{
    const double rate = *(const double *)self;
    out[0] = imp_add(x, imp_sin(imp_scale(y, 2)));
    out[1] = y;
    out[2] = imp_mul(z, imp_cos(imp_scale(t, rate)));
}
IMP_MAP_FORMULA(skew)

#define MISTAKE(NAME, EVAL, RATE, APPLY)                                                           \
    static const imp_map_type NAME##_type = {.struct_size = sizeof(imp_map_type),                  \
                                             .parameter_count = 1,                                 \
                                             .parameter_size = sizeof(imp_parameter),              \
                                             .name = #NAME,                                        \
                                             .summary = "a skew with a mistake",                   \
                                             .equation = "(x + sin 2y, y, z cos(rate t))",         \
                                             .example = #NAME " rate=2",                           \
                                             .parameters = table,                                  \
                                             .create = skew_create,                                \
                                             .destroy = free,                                      \
                                             .time_domain = always,                                \
                                             .eval = EVAL,                                         \
                                             .rate = RATE,                                         \
                                             .apply = APPLY}

static imp_status still(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const imp_status status = skew_rate(self, box, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][3] = 0;
    return status;
}
MISTAKE(map_rate_without_time, skew_eval, still, skew_apply);

static imp_status fixed_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const imp_status status = skew_rate(self, box, rates);
    rates->m[2][3] = fabs(*(const double *)self);
    return status;
}
MISTAKE(map_rate_without_size, skew_eval, fixed_rate, skew_apply);

/* Takes the surface below for its quadratic. */
static imp_status certain(const void *self, const imp_model in[4], imp_model out[3])
{
    imp_model sure[4];
    memcpy(sure, in, sizeof sure);
    for (int i = 0; i < 3; ++i) sure[i].e = 0;
    return skew_apply(self, sure, out);
}
MISTAKE(apply_forgets_remainder, skew_eval, skew_rate, certain);

/* The slopes of the map, as if the surface below had slope 1. */
static imp_status unchained(const void *self, const imp_model in[4], imp_model out[3])
{
    const imp_status status = skew_apply(self, in, out);
    for (int j = 0; j < 3; ++j) out[1].rate[j] = j == 1;
    return status;
}
MISTAKE(apply_forgets_chain_rule, skew_eval, skew_rate, unchained);

static imp_status moment(const void *self, const imp_model in[4], imp_model out[3])
{
    imp_model now[4];
    memcpy(now, in, sizeof now);
    now[3] = imp_num(in[3].a);
    return skew_apply(self, now, out);
}
MISTAKE(apply_of_one_moment, skew_eval, skew_rate, moment);

/* There is no fifth operand. */
static imp_status five(const void *self, const imp_model *in, imp_model out[3])
{
    const imp_model *volatile next = in + 4;
    const imp_status status = skew_apply(self, in, out);
    return next->a == 1e300 ? IMP_STATUS_INTERNAL : status;
}
MISTAKE(apply_reads_too_far, skew_eval, skew_rate, five);

MISTAKE(map_no_mistake, skew_eval, skew_rate, skew_apply);

static const imp_map_type *const maps[] = {
    &map_rate_without_time_type,   &map_rate_without_size_type,
    &apply_forgets_remainder_type, &apply_forgets_chain_rule_type,
    &apply_of_one_moment_type,     &apply_reads_too_far_type,
    &map_no_mistake_type};
static const imp_map_factory factory = {sizeof factory, sizeof maps / sizeof *maps, maps};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_MAP_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("mistakes_map", "1.0", "Apache-2.0", "tests", get_factory);
