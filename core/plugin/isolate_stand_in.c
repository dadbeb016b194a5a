/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/unconst.h"
#include "core/common/capabilities.h"
#include "core/plugin/isolate_internal.h"

#include <stdlib.h>
#include <string.h>

/* The rest of core sees an instance that never changes; the channel of its worker does. */
static isolated_piece *stand_in_of(const void *self) { return unconst(self); }

static channel_work *work_of(const isolated_piece *i) { return &i->whole->worker->channel->work; }

static imp_status enter(isolated_piece *i)
{
    const imp_status status = worker_enter(i->whole->worker, i->whole);
    if (status == IMP_STATUS_OK) work_of(i)->self = i->self;
    return status;
}

static imp_status request(isolated_piece *i, channel_request what)
{
    return worker_request(i->whole->worker, i->whole, what);
}

static void leave(isolated_piece *i) { worker_leave(i->whole->worker); }

static imp_status some_points(isolated_piece *i, size_t n, size_t width, const double *p, double *x,
                              double *error)
{
    channel_work *c = work_of(i);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    c->n = n;
    c->wants_error = error != NULL;
    memcpy(c->p, p, width * n * sizeof *p);
    status = request(i, REQUEST_EVAL);
    memcpy(x, c->x, 3 * n * sizeof *x);
    if (error != NULL) memcpy(error, c->error, 3 * n * sizeof *error);
    leave(i);
    return status;
}

static imp_status points(isolated_piece *i, size_t n, size_t width, const double *p, double *x,
                         double *error)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t from = 0; from < n && status == IMP_STATUS_OK; from += CHANNEL_POINTS) {
        const size_t count = n - from < CHANNEL_POINTS ? n - from : CHANNEL_POINTS;
        status = some_points(i, count, width, p + width * from, x + 3 * from,
                             error != NULL ? error + 3 * from : NULL);
    }
    return status;
}

static void surface_domain_of(const void *self, double lo[3], double hi[3])
{
    memcpy(lo, stand_in_of(self)->lo, 3 * sizeof *lo);
    memcpy(hi, stand_in_of(self)->hi, 3 * sizeof *hi);
}

static imp_status surface_eval_of(const void *self, size_t n, const double *p, double *x,
                                  double *error)
{
    return points(stand_in_of(self), n, 3, p, x, error);
}

static imp_status surface_rate_of(const void *self, const imp_region *region,
                                  imp_rate_matrix *rates)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->region = *region;
    status = request(i, REQUEST_RATE);
    *rates = work_of(i)->rates;
    leave(i);
    return status;
}

static imp_status surface_include_of(const void *self, const imp_region *region, imp_model model[3])
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    bool done;
    status = isolate_include_ahead(i, region, model, &done);
    if (!done) {
        work_of(i)->self = i->self;
        work_of(i)->region = *region;
        status = request(i, REQUEST_INCLUDE);
        memcpy(model, work_of(i)->out, 3 * sizeof *model);
    }
    leave(i);
    return status;
}

/* Asks the worker for a net of a surface or a map. */
static imp_status net_of(const void *self, const imp_region *region, imp_net *net)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->region = *region;
    work_of(i)->net = *net;
    status = request(i, REQUEST_NET);
    *net = work_of(i)->net;
    leave(i);
    return status;
}

static imp_status distance_of(const void *self, const imp_model point[4], imp_model *distance)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    memcpy(work_of(i)->in, point, 4 * sizeof *point);
    status = request(i, REQUEST_DISTANCE);
    *distance = work_of(i)->out[0];
    leave(i);
    return status;
}

static imp_status symmetry_of(const void *self, imp_symmetry *symmetry)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->symmetry = *symmetry;
    status = request(i, REQUEST_SYMMETRY);
    *symmetry = work_of(i)->symmetry;
    leave(i);
    return status;
}

static imp_status tube_of(const void *self, const imp_region *region, imp_tube *tube)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->region = *region;
    work_of(i)->tube = *tube;
    status = request(i, REQUEST_TUBE);
    *tube = work_of(i)->tube;
    leave(i);
    return status;
}

/* Passes the next part of a formula on. *at counts the bytes passed on; *length is that of all. */
static imp_status formula_part(isolated_piece *i, const imp_text_sink *to, size_t *at,
                               size_t *length)
{
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    channel *with = i->whole->worker->channel;
    with->work.n = *at;
    status = request(i, REQUEST_FORMULA);
    *length = with->work.n;
    if (status == IMP_STATUS_OK && *length > *at) {
        const size_t left = *length - *at, count = left < CHANNEL_BYTES ? left : CHANNEL_BYTES;
        to->add(to, (const char *)with->bytes, count);
        *at += count;
    }
    leave(i);
    return status;
}

static imp_status write_formula_of(const void *self, const imp_text_sink *to)
{
    size_t at = 0, length = 0;
    imp_status status = IMP_STATUS_OK;
    do status = formula_part(stand_in_of(self), to, &at, &length);
    while (status == IMP_STATUS_OK && at < length);
    return status;
}

static size_t piece_count_of(const void *self) { return ((const isolated *)self)->piece_count; }

static const void *piece_of(const void *self, size_t k)
{
    const isolated *i = self;
    if (isolate_is_own_piece(i)) return i;
    return i->pieces[k].self != NULL ? &i->pieces[k] : NULL;
}

static void map_times_of(const void *self, double *lo, double *hi)
{
    *lo = stand_in_of(self)->lo[0];
    *hi = stand_in_of(self)->hi[0];
}

static void map_span_of(const void *self, double *lo, double *hi)
{
    *lo = stand_in_of(self)->lo[1];
    *hi = stand_in_of(self)->hi[1];
}

static imp_status map_eval_of(const void *self, size_t n, const double *p, double *x, double *error)
{
    return points(stand_in_of(self), n, 4, p, x, error);
}

static imp_status map_rate_of(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->box = *box;
    status = request(i, REQUEST_RATE);
    *rates = work_of(i)->map_rates;
    leave(i);
    return status;
}

static imp_status map_apply_of(const void *self, const imp_model in[4], imp_model out[3])
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    memcpy(work_of(i)->in, in, 4 * sizeof *in);
    status = request(i, REQUEST_INCLUDE);
    memcpy(out, work_of(i)->out, 3 * sizeof *out);
    leave(i);
    return status;
}

static imp_status map_rigid_of(const void *self, const imp_model *t, imp_pose *pose)
{
    isolated_piece *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    work_of(i)->in[3] = *t;
    work_of(i)->pose = *pose;
    status = request(i, REQUEST_POSE);
    *pose = work_of(i)->pose;
    leave(i);
    return status;
}

/* renew is not offered: an instance in another process is created anew. */
_Static_assert(CAPABILITIES == 12, "stand-ins offer what their types do");

isolated *isolate_surface(worker_pool *pool, const imp_surface_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->own.whole = i;
    i->type.surface = type;
    const bool pieces = IMP_OFFERS(type, piece);
    i->surface_stand_in = (imp_surface_type){
        .struct_size = sizeof i->surface_stand_in,
        .flags = type->flags,
        .name = type->name,
        .destroy = isolate_destroy,
        .domain = surface_domain_of,
        .eval = surface_eval_of,
        .rate = surface_rate_of,
        .include = type->include != NULL ? surface_include_of : NULL,
        .net = type->net != NULL ? net_of : NULL,
        .piece_count = pieces ? piece_count_of : NULL,
        .piece = pieces ? piece_of : NULL,
        .distance = IMP_OFFERS(type, distance) ? distance_of : NULL,
        .symmetry = IMP_OFFERS(type, symmetry) ? symmetry_of : NULL,
        .formula = IMP_OFFERS(type, formula) ? type->formula : NULL,
        .write_formula = IMP_OFFERS(type, write_formula) ? write_formula_of : NULL,
        .tube = IMP_OFFERS(type, tube) ? tube_of : NULL};
    return i;
}

isolated *isolate_map(worker_pool *pool, const imp_map_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->own.whole = i;
    i->type.map = type;
    i->map_stand_in =
        (imp_map_type){.struct_size = sizeof i->map_stand_in,
                       .flags = type->flags,
                       .name = type->name,
                       .destroy = isolate_destroy,
                       .time_domain = map_times_of,
                       .eval = map_eval_of,
                       .rate = map_rate_of,
                       .apply = type->apply != NULL ? map_apply_of : NULL,
                       .net = type->net != NULL ? net_of : NULL,
                       .rigid = IMP_OFFERS(type, rigid) ? map_rigid_of : NULL,
                       .span = IMP_OFFERS(type, span) ? map_span_of : NULL,
                       .formula = IMP_OFFERS(type, formula) ? type->formula : NULL,
                       .write_formula = IMP_OFFERS(type, write_formula) ? write_formula_of : NULL,
                       .parts = IMP_OFFERS(type, parts) ? type->parts : NULL};
    return i;
}

const imp_surface_type *isolate_surface_type(const isolated *i) { return &i->surface_stand_in; }

const imp_map_type *isolate_map_type(const isolated *i) { return &i->map_stand_in; }
