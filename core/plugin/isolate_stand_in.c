/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/unconst.h"
#include "core/common/capabilities.h"
#include "core/plugin/isolate_internal.h"

#include <stdlib.h>
#include <string.h>

/* The rest of core sees an instance that never changes; the channel of its worker does. */
static isolated *stand_in_of(const void *self) { return (isolated *)(uintptr_t)self; }

static imp_status enter(isolated *i)
{
    const imp_status status = worker_enter(i->worker, i->user);
    if (status == IMP_STATUS_OK) i->worker->channel->work.self = i->self;
    return status;
}

static imp_status some_points(isolated *i, size_t n, size_t width, const double *p, double *x,
                              double *error)
{
    channel_work *c = &i->worker->channel->work;
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    c->n = n;
    c->wants_error = error != NULL;
    memcpy(c->p, p, width * n * sizeof *p);
    status = worker_request(i->worker, i->user, REQUEST_EVAL);
    memcpy(x, c->x, 3 * n * sizeof *x);
    if (error != NULL) memcpy(error, c->error, 3 * n * sizeof *error);
    worker_leave(i->worker);
    return status;
}

static imp_status points(isolated *i, size_t n, size_t width, const double *p, double *x,
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
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    i->worker->channel->work.region = *region;
    status = worker_request(i->worker, i->user, REQUEST_RATE);
    *rates = i->worker->channel->work.rates;
    worker_leave(i->worker);
    return status;
}

/* Whether the region is the whole domain of the piece, at some times. */
static bool is_whole(const isolated *piece, const imp_region *region)
{
    return memcmp(piece->lo, region->lo, 2 * sizeof *piece->lo) == 0 &&
           memcmp(piece->hi, region->hi, 2 * sizeof *piece->hi) == 0;
}

/* Asks for the models of piece k and of those after it. */
static imp_status look_ahead(isolated *whole, size_t k, const imp_region *region)
{
    inclusions_ahead *a = whole->ahead;
    channel *with = whole->worker->channel;
    channel_work *c = &with->work;
    c->self = whole->self;
    c->n = k;
    c->pieces = whole->piece_count;
    c->region = *region;
    const imp_status status = worker_request(whole->worker, whole, REQUEST_INCLUDE_PIECES);
    const size_t most = sizeof a->at / sizeof *a->at;
    a->first = k;
    a->count = status == IMP_STATUS_OK && c->pieces <= most ? c->pieces : 0;
    a->times[0] = region->lo[2];
    a->times[1] = region->hi[2];
    memcpy(a->at, with->bytes, a->count * sizeof *a->at);
    return status;
}

/* Takes the model of a piece from those that came ahead. *done false: there is none, ask for it
 * alone. The worker has been entered. */
static imp_status include_ahead(isolated *piece, const imp_region *region, imp_model model[3],
                                bool *done)
{
    isolated *whole = unconst(piece->user);
    *done = false;
    if (whole == piece || !is_whole(piece, region)) return IMP_STATUS_OK;
    const size_t k = (size_t)(piece - whole->pieces);
    if (whole->ahead == NULL) whole->ahead = calloc(1, sizeof *whole->ahead);
    inclusions_ahead *a = whole->ahead;
    if (a == NULL) return IMP_STATUS_OK;
    const bool same =
        memcmp(a->times, (double[]){region->lo[2], region->hi[2]}, sizeof a->times) == 0;
    const bool follows = k == 0 || (same && k == a->first + a->count);
    imp_status status = IMP_STATUS_OK;
    if (!(same && k >= a->first && k - a->first < a->count)) {
        if (!follows) return IMP_STATUS_OK;
        status = look_ahead(whole, k, region);
    }
    *done = status != IMP_STATUS_OK || a->count > 0;
    if (status != IMP_STATUS_OK || a->count == 0) return status;
    memcpy(model, a->at[k - a->first].model, 3 * sizeof *model);
    return a->at[k - a->first].status;
}

static imp_status surface_include_of(const void *self, const imp_region *region, imp_model model[3])
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    bool done;
    status = include_ahead(i, region, model, &done);
    if (!done) {
        i->worker->channel->work.self = i->self;
        i->worker->channel->work.region = *region;
        status = worker_request(i->worker, i->user, REQUEST_INCLUDE);
        memcpy(model, i->worker->channel->work.out, 3 * sizeof *model);
    }
    worker_leave(i->worker);
    return status;
}

/* Asks the worker for a net of a surface or a map. */
static imp_status net_of(const void *self, const imp_region *region, imp_net *net)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    i->worker->channel->work.region = *region;
    i->worker->channel->work.net = *net;
    status = worker_request(i->worker, i->user, REQUEST_NET);
    *net = i->worker->channel->work.net;
    worker_leave(i->worker);
    return status;
}

static imp_status distance_of(const void *self, const imp_model point[4], imp_model *distance)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    memcpy(i->worker->channel->work.in, point, 4 * sizeof *point);
    status = worker_request(i->worker, i->user, REQUEST_DISTANCE);
    *distance = i->worker->channel->work.out[0];
    worker_leave(i->worker);
    return status;
}

static imp_status symmetry_of(const void *self, imp_symmetry *symmetry)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    i->worker->channel->work.symmetry = *symmetry;
    status = worker_request(i->worker, i->user, REQUEST_SYMMETRY);
    *symmetry = i->worker->channel->work.symmetry;
    worker_leave(i->worker);
    return status;
}

/* Passes the next part of a formula on. *at counts the bytes passed on; *length is that of all. */
static imp_status formula_part(isolated *i, const imp_text_sink *to, size_t *at, size_t *length)
{
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    channel *with = i->worker->channel;
    with->work.n = *at;
    status = worker_request(i->worker, i->user, REQUEST_FORMULA);
    *length = with->work.n;
    if (status == IMP_STATUS_OK && *length > *at) {
        const size_t left = *length - *at, count = left < CHANNEL_BYTES ? left : CHANNEL_BYTES;
        to->add(to, (const char *)with->bytes, count);
        *at += count;
    }
    worker_leave(i->worker);
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

static size_t piece_count_of(const void *self) { return stand_in_of(self)->piece_count; }

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
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    i->worker->channel->work.box = *box;
    status = worker_request(i->worker, i->user, REQUEST_RATE);
    *rates = i->worker->channel->work.map_rates;
    worker_leave(i->worker);
    return status;
}

static imp_status map_apply_of(const void *self, const imp_model in[4], imp_model out[3])
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    memcpy(i->worker->channel->work.in, in, 4 * sizeof *in);
    status = worker_request(i->worker, i->user, REQUEST_INCLUDE);
    memcpy(out, i->worker->channel->work.out, 3 * sizeof *out);
    worker_leave(i->worker);
    return status;
}

static imp_status map_rigid_of(const void *self, const imp_model *t, imp_pose *pose)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_STATUS_OK) return status;
    i->worker->channel->work.in[3] = *t;
    i->worker->channel->work.pose = *pose;
    status = worker_request(i->worker, i->user, REQUEST_POSE);
    *pose = i->worker->channel->work.pose;
    worker_leave(i->worker);
    return status;
}

_Static_assert(CAPABILITIES == 9, "stand-ins offer what their types do");

isolated *isolate_surface(worker_pool *pool, const imp_surface_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->user = i;
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
        .write_formula = IMP_OFFERS(type, write_formula) ? write_formula_of : NULL};
    return i;
}

isolated *isolate_map(worker_pool *pool, const imp_map_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->user = i;
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
                       .write_formula = IMP_OFFERS(type, write_formula) ? write_formula_of : NULL};
    return i;
}

const imp_surface_type *isolate_surface_type(const isolated *i) { return &i->surface_stand_in; }

const imp_map_type *isolate_map_type(const isolated *i) { return &i->map_stand_in; }
