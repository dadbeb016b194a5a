/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/calls.h"

#include <impinge/formula.h>

enum { POINTS = 64 };

static void call_eval(const subject *s, uint64_t *random)
{
    double p[POINTS * BOX_DIMS], x[POINTS * 3], error[POINTS * 3];
    const size_t count = draw_index(random, 2) > 0 ? 1 : draw_index(random, POINTS + 1);
    for (size_t k = 0; k < count; ++k) draw_point(random, &s->domain, s->n, p + k * (size_t)s->n);
    subject_eval(s, count, p, x, error);
}

static void call_rate(const subject *s, uint64_t *random)
{
    double rate[3][BOX_DIMS];
    const box where = draw_box(random, &s->domain, s->n);
    subject_rate(s, &where, rate);
}

static void call_model(const subject *s, uint64_t *random)
{
    imp_model model[3];
    subject_model(s, draw_box(random, &s->domain, s->n), model);
}

/* Asks for a net, beginning with a point at the origin, which rests. */
static void call_net(const subject *s, uint64_t *random)
{
    const imp_instance *i = s->instance;
    const box where = draw_box(random, &s->domain, s->n);
    imp_net net = {.degree = {1, 1}};
    if (i->surface != NULL && i->surface->net != NULL) {
        const imp_region region = imp_region_between(where.lo, where.hi);
        subject_net(s, &region, &net);
    } else if (i->map != NULL && i->map->net != NULL) {
        const imp_region region = subject_span(&where);
        subject_map_net(s, &region, &net);
    }
}

static void call_rigid(const subject *s, uint64_t *random)
{
    const box where = draw_box(random, &s->domain, s->n);
    const imp_region span = subject_span(&where);
    imp_pose pose;
    if (subject_is_rigid(s)) subject_pose(s, &span, &pose);
}

static void call_distance(const subject *s, uint64_t *random)
{
    const box space = {{-2, -2, -2, s->domain.lo[2]}, {2, 2, 2, s->domain.hi[2]}};
    const box where = draw_box(random, &space, 4);
    imp_model in[4], g;
    subject_operands(&where, in);
    if (subject_has_distance(s)) subject_distance(s, in, &g);
}

static void call_symmetry(const subject *s, uint64_t *random)
{
    imp_symmetry symmetry;
    (void)random;
    subject_symmetry(s, &symmetry);
}

static void call_tube(const subject *s, uint64_t *random)
{
    const box where = draw_box(random, &s->domain, s->n);
    imp_tube tube;
    if (!subject_has_tube(s)) return;
    const imp_region region = imp_region_between(where.lo, where.hi);
    subject_tube(s, &region, &tube);
}

static const struct {
    const char *name, *of_map; /* of_map: NULL: called so there too */
    void (*call)(const subject *s, uint64_t *random);
} all[PURE_CALLS] = {
    {"eval", NULL, call_eval},         {"rate", NULL, call_rate},
    {"include", "apply", call_model},  {"net", NULL, call_net},
    {"rigid", NULL, call_rigid},       {"distance", NULL, call_distance},
    {"symmetry", NULL, call_symmetry}, {"tube", NULL, call_tube},
};

void pure_call(const subject *s, size_t which, uint64_t *random) { all[which].call(s, random); }

const char *pure_call_name(const subject *s, size_t which)
{
    return s->n == 4 && all[which].of_map != NULL ? all[which].of_map : all[which].name;
}
