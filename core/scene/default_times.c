/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/default_times.h"

#include <math.h>

#include "core/scene/scene.h"

/* The type of a surface of a body, or one of its maps. */
typedef struct owned_instance {
    const surface *of;
    size_t body;
    surface_instance instance;
} owned_instance;

typedef struct gathered_times {
    double from, to; /* when all is defined */
    owned_instance first,
        last;      /* what begins last, and what ends first; of == NULL: nothing does */
    double lo, hi; /* all spans together; lo > hi: there is none */
} gathered_times;

static void gather_instance(gathered_times *g, const owned_instance *p)
{
    const double *span = p->instance.span;
    if (span[0] > -INFINITY && span[1] < INFINITY) {
        if (span[0] < g->lo) g->lo = span[0];
        if (span[1] > g->hi) g->hi = span[1];
    }
    if (p->instance.absent) return;
    if (p->instance.lo > g->from) {
        g->from = p->instance.lo;
        g->first = *p;
    }
    if (p->instance.hi < g->to) {
        g->to = p->instance.hi;
        g->last = *p;
    }
}

static gathered_times gather(const imp_scene *scene)
{
    gathered_times g = {.from = -INFINITY, .to = INFINITY, .lo = INFINITY, .hi = -INFINITY};
    const size_t bodies = scene_body_count(scene);
    for (size_t b = 0; b < bodies; ++b) {
        const size_t surfaces = scene_surface_count(scene, b);
        for (size_t k = 0; k < surfaces; ++k) {
            owned_instance p = {.of = scene_surface(scene, b, k), .body = b};
            for (size_t i = 0; surface_instance_at(p.of, i, &p.instance); ++i)
                gather_instance(&g, &p);
        }
    }
    return g;
}

static imp_code refuse(const imp_scene *scene, const gathered_times *g, imp_error *error)
{
    surface_fault(
        g->first.of, error,
        ": '%s' is defined from t = %.10g on, but '%s' of body '%.80s' only up to t = %.10g; "
        "name the times to examine: \"time\" in the scene, or --time",
        g->first.instance.name, g->from, g->last.instance.name,
        imp_scene_body_name(scene, g->last.body), g->to);
    if (error != NULL) error->code = IMP_ERROR_SCENE;
    return IMP_ERROR_SCENE;
}

static double clip(double t, double lo, double hi) { return t < lo ? lo : t > hi ? hi : t; }

/* Precondition: all is defined from g->from to g->to, which is not empty. Both are finite, or one
 * of them, or neither. */
static void choose(const gathered_times *g, double time[2])
{
    const bool both = g->from > -INFINITY && g->to < INFINITY;
    const bool spans = g->lo <= g->hi && g->lo <= g->to && g->hi >= g->from;
    const double unit = g->from > 0 ? g->from : g->to < 1 ? g->to - 1 : 0;
    time[0] = both ? g->from : spans ? clip(g->lo, g->from, g->to) : unit;
    time[1] = both ? g->to : spans ? clip(g->hi, g->from, g->to) : unit + 1;
}

imp_code default_times(const imp_scene *scene, double time[2], imp_error *error)
{
    const gathered_times g = gather(scene);
    time[0] = time[1] = NAN;
    if (g.from > g.to) return refuse(scene, &g, error);
    choose(&g, time);
    return IMP_SUCCESS;
}
