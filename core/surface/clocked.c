/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/clocked.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

/* What `self` points to in the callbacks of a map, and of a surface or one of its pieces. The types
 * are copies whose callbacks are those below; `destroy` frees the whole. */
typedef struct clocked_map {
    imp_map_type type;
    const imp_map_type *own;
    void *self;
    double value;
} clocked_map;

typedef struct clocked_surface {
    const imp_surface_type *own;
    const void *self;
    double value;
} clocked_surface;

typedef struct clocked_whole {
    clocked_surface surface; /* the first member, so that callbacks take it for a piece */
    imp_surface_type type;
    size_t piece_count;
    clocked_surface pieces[];
} clocked_whole;

static imp_model constant(double value)
{
    return (imp_model){.a = value, .lo = value, .hi = value};
}

/* The times of the region become the one value. */
static imp_region at_value(const imp_region *region, double value)
{
    imp_region at = *region;
    at.lo[2] = at.hi[2] = at.c[2] = value;
    at.d[2] = 0;
    return at;
}

/* --- Nets ------------------------------------------------------------------------------------- */

static bool is_moving(const imp_net *net)
{
    bool drifts = net->is_moving != 0;
    for (int i = 0; i < 3; ++i) drifts = drifts || net->drift[i] != 0;
    return drifts;
}

/* Lemma. Over a region of the one time c the net holds at tau = t - c = 0, where velocities and
 * drift do not count: without them it holds at the value, and hence, for what is held there, at all
 * times. */
static void hold_net(imp_net *net)
{
    net->is_moving = 0;
    memset(net->drift, 0, sizeof net->drift);
    memset(net->velocity, 0, sizeof net->velocity);
}

/* --- Maps ------------------------------------------------------------------------------------- */

enum { BATCH = 16 }; /* points per call of the map's own eval; keeps the buffer on the stack */

static imp_status map_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    const clocked_map *m = self;
    double at[4 * BATCH];
    for (size_t from = 0; from < n; from += BATCH) {
        const size_t count = n - from < BATCH ? n - from : BATCH;
        memcpy(at, p + 4 * from, 4 * count * sizeof *at);
        for (size_t k = 0; k < count; ++k) at[4 * k + 3] = m->value;
        const imp_status status =
            m->own->eval(m->self, count, at, x + 3 * from, error != NULL ? error + 3 * from : NULL);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status map_rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const clocked_map *m = self;
    imp_box4 at = *box;
    at.lo[3] = at.hi[3] = m->value;
    const imp_status status = m->own->rate(m->self, &at, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][3] = 0;
    return status;
}

static imp_status map_apply(const void *self, const imp_model in[4], imp_model out[3])
{
    const clocked_map *m = self;
    const imp_model at[4] = {in[0], in[1], in[2], constant(m->value)};
    return m->own->apply(m->self, at, out);
}

/* A net that moves has none: how the map moves velocities is not known of a region of one time. */
static imp_status map_net(const void *self, const imp_region *region, imp_net *net)
{
    const clocked_map *m = self;
    if (is_moving(net)) return IMP_STATUS_UNBOUNDED;
    const imp_region at = at_value(region, m->value);
    const imp_status status = m->own->net(m->self, &at, net);
    hold_net(net);
    return status;
}

/* Lemma. |s| <= 1, so that a term of s adds its coefficient at most to the remainder. Three
 * additions of non-negative numbers. */
PAD_COVERS(8, 3);
static void hold_model(imp_model *m)
{
    if (m->depends == 0) return;
    const double more = fabs(m->b[2]) + fabs(m->q[IMP_TT]);
    if (more > 0) m->e = padded_upper(m->e + more, 8);
    m->b[2] = m->q[IMP_TT] = m->rate[2] = 0;
    m->depends &= ~(1u << PARAMETER_T);
}

static imp_status map_rigid(const void *self, const imp_model *t, imp_pose *pose)
{
    const clocked_map *m = self;
    const imp_model at = constant(m->value);
    (void)t;
    const imp_status status = m->own->rigid(m->self, &at, pose);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) hold_model(&pose->turn[i][j]);
        hold_model(&pose->shift[i]);
    }
    return status;
}

static void map_time_domain(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY, *hi = INFINITY;
}

static shared_instance *map_at(shared_instance *inner, double value)
{
    const imp_map_type *own = inner->map;
    clocked_map *m = malloc(sizeof *m);
    if (m == NULL) return NULL;
    *m = (clocked_map){.type = {.struct_size = sizeof(imp_map_type),
                                .flags = own->flags & IMP_FLAG_TURNS_EXACTLY,
                                .name = own->name,
                                .summary = own->summary,
                                .equation = own->equation,
                                .destroy = free,
                                .time_domain = map_time_domain,
                                .eval = map_eval,
                                .rate = map_rate,
                                .apply = own->apply != NULL ? map_apply : NULL,
                                .net = own->net != NULL ? map_net : NULL,
                                .rigid = IMP_OFFERS(own, rigid) ? map_rigid : NULL},
                       .own = own,
                       .self = inner->self,
                       .value = value};
    return instance_of_map(&m->type, m);
}

/* --- Surfaces --------------------------------------------------------------------------------- */

const void *clocked_self(const void *self) { return ((const clocked_surface *)self)->self; }

static void surface_times(const void *self, double lo[3], double hi[3])
{
    const clocked_surface *s = self;
    s->own->domain(s->self, lo, hi);
    lo[2] = -INFINITY, hi[2] = INFINITY;
}

static imp_status surface_eval_at(const void *self, size_t n, const double *p, double *x,
                                  double *error)
{
    const clocked_surface *s = self;
    double at[3 * BATCH];
    for (size_t from = 0; from < n; from += BATCH) {
        const size_t count = n - from < BATCH ? n - from : BATCH;
        memcpy(at, p + 3 * from, 3 * count * sizeof *at);
        for (size_t k = 0; k < count; ++k) at[3 * k + 2] = s->value;
        const imp_status status =
            s->own->eval(s->self, count, at, x + 3 * from, error != NULL ? error + 3 * from : NULL);
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

static imp_status surface_rate_at(const void *self, const imp_region *region,
                                  imp_rate_matrix *rates)
{
    const clocked_surface *s = self;
    const imp_region at = at_value(region, s->value);
    const imp_status status = s->own->rate(s->self, &at, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][PARAMETER_T] = 0;
    return status;
}

/* Lemma. Over a region whose d[2] is 0, s_2 is 0: its terms are. */
static imp_status surface_include_at(const void *self, const imp_region *region, imp_model model[3])
{
    const clocked_surface *s = self;
    const imp_region at = at_value(region, s->value);
    const imp_status status = s->own->include(s->self, &at, model);
    for (int i = 0; i < 3; ++i) {
        model[i].b[2] = model[i].rate[2] = 0;
        model[i].q[IMP_UT] = model[i].q[IMP_VT] = model[i].q[IMP_TT] = 0;
        model[i].depends &= ~(1u << PARAMETER_T);
    }
    return status;
}

static imp_status surface_net_at(const void *self, const imp_region *region, imp_net *net)
{
    const clocked_surface *s = self;
    const imp_region at = at_value(region, s->value);
    const imp_status status = s->own->net(s->self, &at, net);
    hold_net(net);
    return status;
}

static size_t surface_count_pieces(const void *self)
{
    const clocked_whole *w = self;
    return w->piece_count;
}

static const void *surface_piece_at(const void *self, size_t k)
{
    const clocked_whole *w = self;
    return &w->pieces[k];
}

static imp_status surface_distance_at(const void *self, const imp_model point[4],
                                      imp_model *distance)
{
    const clocked_surface *s = self;
    const imp_model at[4] = {point[0], point[1], point[2], constant(s->value)};
    return s->own->distance(s->self, at, distance);
}

static imp_status surface_symmetry_at(const void *self, imp_symmetry *symmetry)
{
    const clocked_surface *s = self;
    return s->own->symmetry(s->self, symmetry);
}

/* A type with an instance of pieces offers pieces of all instances; one of a single piece is that
 * piece. */
static shared_instance *surface_at(shared_instance *inner, double value)
{
    const imp_surface_type *own = inner->surface;
    const size_t count = inner->piece_count;
    clocked_whole *w = malloc(sizeof *w + count * sizeof *w->pieces);
    if (w == NULL) return NULL;
    const void *self = count > 0 ? inner->pieces[0] : inner->self;
    *w = (clocked_whole){
        .surface = {own, self, value},
        .type = {.struct_size = sizeof(imp_surface_type),
                 .name = own->name,
                 .summary = own->summary,
                 .equation = own->equation,
                 .destroy = free,
                 .domain = surface_times,
                 .eval = surface_eval_at,
                 .rate = surface_rate_at,
                 .include = own->include != NULL ? surface_include_at : NULL,
                 .net = own->net != NULL ? surface_net_at : NULL,
                 .piece_count = count > 0 ? surface_count_pieces : NULL,
                 .piece = count > 0 ? surface_piece_at : NULL,
                 .distance = IMP_OFFERS(own, distance) ? surface_distance_at : NULL,
                 .symmetry = IMP_OFFERS(own, symmetry) ? surface_symmetry_at : NULL},
        .piece_count = count};
    for (size_t k = 0; k < count; ++k)
        w->pieces[k] = (clocked_surface){own, inner->pieces[k], value};
    return instance_of_surface(&w->type, w);
}

shared_instance *clocked_new(shared_instance *inner, size_t clock, double value)
{
    shared_instance *p = inner->surface != NULL ? surface_at(inner, value) : map_at(inner, value);
    if (p == NULL) return NULL;
    p->clock = (uint32_t)clock;
    p->inner = instance_hold(inner);
    p->given = inner->piece_count * sizeof(clocked_surface);
    if (inner->note == NULL || instance_set_note(p, inner->note_count, inner->note)) return p;
    instance_release(p);
    return NULL;
}
