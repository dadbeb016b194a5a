/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* Maps of parts that can be read, all of which state them in order but for the mistake that the
 * name says. What their eval answers does not know of the parts. */

enum { OFFSET };

static const imp_parameter parameters[] = {
    [OFFSET] = {.name = "offset",
                .unit = "length",
                .doc = "how far it moves",
                .default_value = "1",
                .kind = IMP_KIND_NUMBER,
                .min = 0,
                .max = 1e6},
};

typedef struct moved {
    double offset;
} moved;

static imp_status moved_create(const imp_value *values, void **self, imp_create_error *why)
{
    moved *made = malloc(sizeof *made);
    (void)why;
    if (made == NULL) return IMP_STATUS_INTERNAL;
    made->offset = values[OFFSET].number[0];
    *self = made;
    return IMP_STATUS_OK;
}

static void always(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

/* Nothing moves. */
static void rest(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                 imp_model out[3])
{
    (void)self, (void)t;
    out[0] = x, out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(rest)

/* What the parts move is moved. */
static void half(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                 imp_model out[3])
{
    const moved *m = self;
    (void)t;
    out[0] = imp_shift(x, 0.5 * m->offset), out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(half)

static void one_ahead(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                      imp_model out[3])
{
    (void)self, (void)t;
    out[0] = imp_shift(x, 1), out[1] = y, out[2] = z;
}
IMP_MAP_FORMULA(one_ahead)

/* Along time, too, as one part of it. */
static void drift(const void *self, imp_model x, imp_model y, imp_model z, imp_model t,
                  imp_model out[3])
{
    (void)self;
    out[0] = x, out[1] = imp_add(y, t), out[2] = z;
}
IMP_MAP_FORMULA(drift)

#define MISTAKE(NAME, FORMULA, PARTS)                                                              \
    static const imp_map_type NAME##_type = {.struct_size = sizeof(imp_map_type),                  \
                                             .parameter_count = 1,                                 \
                                             .parameter_size = sizeof(imp_parameter),              \
                                             .name = #NAME,                                        \
                                             .summary = "a map of parts with a mistake",           \
                                             .equation =                                           \
                                                 "(x, y, z) where its clocks are in the middle",   \
                                             .example = #NAME,                                     \
                                             .parameters = parameters,                             \
                                             .create = moved_create,                               \
                                             .destroy = free,                                      \
                                             .time_domain = always,                                \
                                             .eval = FORMULA##_eval,                               \
                                             .rate = FORMULA##_rate,                               \
                                             .apply = FORMULA##_apply,                             \
                                             .parts = PARTS}

#define SHIFT(CLOCK) "translate velocity=1,0,0 clock=" CLOCK

MISTAKE(parts_off_the_middle, rest, SHIFT("0,$offset"));
MISTAKE(parts_not_still_at_0, one_ahead,
        "translate offset=[[1,0,0],[1,0,0]] clock=-$offset,$offset");
MISTAKE(parts_end_early, rest, "map-formula x=x+t time=-0.25,0.25 clock=-$offset,$offset");
MISTAKE(parts_forget_time, drift, SHIFT("-$offset,$offset"));
MISTAKE(parts_follow_no_mistake, drift, SHIFT("-$offset,$offset") " ! translate velocity=0,1,0");
MISTAKE(parts_no_mistake, half, SHIFT("0,$offset"));

static const imp_map_type *const maps[] = {
    &parts_off_the_middle_type, &parts_not_still_at_0_type,    &parts_end_early_type,
    &parts_forget_time_type,    &parts_follow_no_mistake_type, &parts_no_mistake_type};
static const imp_map_factory factory = {sizeof factory, sizeof maps / sizeof *maps, maps};

static const void *get_factory(const char *id)
{
    return strcmp(id, IMP_MAP_FACTORY) == 0 ? &factory : NULL;
}
IMPINGE_PLUGIN("mistakes_parts", "1.0", "Apache-2.0", "tests", get_factory);
