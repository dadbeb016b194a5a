/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"
#include "core/common/system_error.h"
#include "core/plugin/isolate.h"
#include "core/base/unconst.h"
#include "core/plugin/value_bytes.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct isolated {
    worker_type type;
    imp_surface_type surface_stand_in; /* one of the two is in use */
    imp_map_type map_stand_in;
    worker_pool *pool;
    worker *worker;      /* NULL: none was to be had */
    void *self;          /* the instance, as the worker knows it; NULL: not created */
    const void *user;    /* whose requests they are: itself, or what it is a piece of */
    double lo[3], hi[3]; /* domain; a map: times in [0] */
    isolated *pieces;    /* piece_count of them, unless that breaks the ABI; or NULL */
    size_t piece_count;
};

/* --- Creation and destruction ------------------------------------------------------------ */

/* Sends the values in parts; they are used by the REQUEST_CREATE that follows. */
static imp_status send_bytes(isolated *i, const unsigned char *bytes, size_t size)
{
    channel *c = i->worker->channel;
    imp_status status = IMP_OK;
    for (size_t at = 0; at < size && status == IMP_OK; at += c->n) {
        c->n = size - at < CHANNEL_BYTES ? size - at : CHANNEL_BYTES;
        memcpy(c->bytes, bytes + at, c->n);
        status = worker_request(i->worker, i, REQUEST_VALUES);
    }
    return status;
}

static imp_status request_create(isolated *i, const unsigned char *bytes, size_t size, size_t count,
                                 imp_create_error *why)
{
    channel *c = i->worker->channel;
    imp_status status = worker_enter(i->worker, i);
    if (status != IMP_OK) return status;
    c->why = *why;
    status = send_bytes(i, bytes, size);
    c->n = count;
    if (status == IMP_OK) status = worker_request(i->worker, i, REQUEST_CREATE);
    *why = c->why;
    i->self = status == IMP_OK ? c->self : NULL;
    memcpy(i->lo, c->lo, sizeof i->lo);
    memcpy(i->hi, c->hi, sizeof i->hi);
    i->piece_count = status == IMP_OK ? c->pieces : 0;
    worker_leave(i->worker);
    return status;
}

/* Asks for all pieces; one that is NULL stays without `self`. */
static imp_status request_pieces(isolated *i)
{
    channel *c = i->worker->channel;
    imp_status status = worker_enter(i->worker, i);
    if (status != IMP_OK) return status;
    for (size_t k = 0; k < i->piece_count && status == IMP_OK; ++k) {
        isolated *piece = &i->pieces[k];
        c->self = i->self;
        c->n = k;
        status = worker_request(i->worker, i, REQUEST_PIECE);
        *piece = (isolated){.type = i->type,
                            .worker = i->worker,
                            .user = i,
                            .self = status == IMP_OK ? unconst(c->piece) : NULL};
        memcpy(piece->lo, c->lo, sizeof piece->lo);
        memcpy(piece->hi, c->hi, sizeof piece->hi);
    }
    worker_leave(i->worker);
    return status;
}

/* A count that breaks the ABI is the host's to refuse. */
static imp_status create_pieces(isolated *i)
{
    if (i->piece_count == 0 || i->piece_count > IMP_PIECES_MAX) return IMP_OK;
    i->pieces = malloc(i->piece_count * sizeof *i->pieces);
    return i->pieces != NULL ? request_pieces(i) : IMP_INTERNAL;
}

/* For messages: the callback that this thread began last is the one that ended the worker. */
static void name_callback(const isolated *i)
{
    static const char *const names[CALLBACK_COUNT] = {"create", "domain", "time_domain",
                                                      "piece_count", "piece"};
    const unsigned last = i->worker != NULL ? atomic_load(&i->worker->channel->callback) : 0;
    active_callback_begin(i->type.surface != NULL ? i->type.surface->name : i->type.map->name,
                          names[last < CALLBACK_COUNT ? last : CALLBACK_CREATE]);
    active_callback_end();
}

static imp_status create(isolated *i, const imp_value *values, imp_create_error *why)
{
    const size_t count =
        i->type.surface != NULL ? i->type.surface->parameter_count : i->type.map->parameter_count;
    const size_t size = value_bytes_size(values, count);
    unsigned char *bytes = malloc(size + 1);
    i->worker = bytes != NULL ? worker_pool_take(i->pool, i->type) : NULL;
    if (i->worker == NULL) {
        snprintf(why->text, sizeof why->text, "%s", system_error_text(errno));
        free(bytes);
        return SURFACE_NO_PROCESS;
    }
    value_bytes_write(values, count, bytes);
    const imp_status status = request_create(i, bytes, size, count, why);
    free(bytes);
    if (status == IMP_OK && i->self == NULL) return IMP_INTERNAL;
    return status == IMP_OK ? create_pieces(i) : status;
}

imp_status isolate_create(isolated *i, const imp_value *values, imp_create_error *why)
{
    const imp_status status = create(i, values, why);
    if (status > IMP_INTERNAL) name_callback(i);
    return status;
}

/* There is no one to answer to: the pool keeps what went wrong. */
static void request_destroy(isolated *i)
{
    if (i->self == NULL || worker_enter(i->worker, i) != IMP_OK) return;
    i->worker->channel->self = i->self;
    const imp_status end = worker_request(i->worker, i, REQUEST_DESTROY);
    worker_leave(i->worker);
    if (end == SURFACE_CRASHED || end == SURFACE_HUNG) worker_pool_note(i->pool, i->type, end);
}

void isolate_destroy(void *self)
{
    isolated *i = self;
    if (i == NULL) return;
    request_destroy(i);
    if (i->worker != NULL) worker_pool_return(i->pool, i->worker);
    free(i->pieces);
    free(i);
}

/* --- The stand-ins' callbacks --------------------------------------------------------------- */

/* The rest of core sees an instance that never changes; the channel of its worker does. */
static isolated *stand_in_of(const void *self) { return (isolated *)(uintptr_t)self; }

static imp_status enter(isolated *i)
{
    const imp_status status = worker_enter(i->worker, i->user);
    if (status == IMP_OK) i->worker->channel->self = i->self;
    return status;
}

static imp_status some_points(isolated *i, size_t n, size_t width, const double *p, double *x,
                              double *error)
{
    channel *c = i->worker->channel;
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
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
    imp_status status = IMP_OK;
    for (size_t from = 0; from < n && status == IMP_OK; from += CHANNEL_POINTS) {
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
    if (status != IMP_OK) return status;
    i->worker->channel->region = *region;
    status = worker_request(i->worker, i->user, REQUEST_RATE);
    *rates = i->worker->channel->rates;
    worker_leave(i->worker);
    return status;
}

static imp_status surface_include_of(const void *self, const imp_region *region, imp_model model[3])
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
    i->worker->channel->region = *region;
    status = worker_request(i->worker, i->user, REQUEST_INCLUDE);
    memcpy(model, i->worker->channel->out, 3 * sizeof *model);
    worker_leave(i->worker);
    return status;
}

/* Of a surface or a map. */
static imp_status net_of(const void *self, const imp_region *region, imp_net *net)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
    i->worker->channel->region = *region;
    i->worker->channel->net = *net;
    status = worker_request(i->worker, i->user, REQUEST_NET);
    *net = i->worker->channel->net;
    worker_leave(i->worker);
    return status;
}

static size_t piece_count_of(const void *self) { return stand_in_of(self)->piece_count; }

static const void *piece_of(const void *self, size_t k)
{
    const isolated *i = self;
    return i->pieces[k].self != NULL ? &i->pieces[k] : NULL;
}

static void map_times_of(const void *self, double *lo, double *hi)
{
    *lo = stand_in_of(self)->lo[0];
    *hi = stand_in_of(self)->hi[0];
}

static imp_status map_eval_of(const void *self, size_t n, const double *p, double *x, double *error)
{
    return points(stand_in_of(self), n, 4, p, x, error);
}

static imp_status map_rate_of(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
    i->worker->channel->box = *box;
    status = worker_request(i->worker, i->user, REQUEST_RATE);
    *rates = i->worker->channel->map_rates;
    worker_leave(i->worker);
    return status;
}

static imp_status map_apply_of(const void *self, const imp_model in[4], imp_model out[3])
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
    memcpy(i->worker->channel->in, in, 4 * sizeof *in);
    status = worker_request(i->worker, i->user, REQUEST_INCLUDE);
    memcpy(out, i->worker->channel->out, 3 * sizeof *out);
    worker_leave(i->worker);
    return status;
}

static imp_status map_rigid_of(const void *self, const imp_model *t, imp_pose *pose)
{
    isolated *i = stand_in_of(self);
    imp_status status = enter(i);
    if (status != IMP_OK) return status;
    i->worker->channel->in[3] = *t;
    i->worker->channel->pose = *pose;
    status = worker_request(i->worker, i->user, REQUEST_POSE);
    *pose = i->worker->channel->pose;
    worker_leave(i->worker);
    return status;
}

isolated *isolate_surface(worker_pool *pool, const imp_surface_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->user = i;
    i->type.surface = type;
    const bool pieces = part_offers_pieces(type);
    i->surface_stand_in =
        (imp_surface_type){.struct_size = sizeof i->surface_stand_in,
                           .flags = type->flags,
                           .name = type->name,
                           .destroy = isolate_destroy,
                           .domain = surface_domain_of,
                           .eval = surface_eval_of,
                           .rate = surface_rate_of,
                           .include = type->include != NULL ? surface_include_of : NULL,
                           .net = type->net != NULL ? net_of : NULL,
                           .piece_count = pieces ? piece_count_of : NULL,
                           .piece = pieces ? piece_of : NULL};
    return i;
}

isolated *isolate_map(worker_pool *pool, const imp_map_type *type)
{
    isolated *i = calloc(1, sizeof *i);
    if (i == NULL) return NULL;
    i->pool = pool;
    i->user = i;
    i->type.map = type;
    i->map_stand_in = (imp_map_type){.struct_size = sizeof i->map_stand_in,
                                     .flags = type->flags,
                                     .name = type->name,
                                     .destroy = isolate_destroy,
                                     .time_domain = map_times_of,
                                     .eval = map_eval_of,
                                     .rate = map_rate_of,
                                     .apply = type->apply != NULL ? map_apply_of : NULL,
                                     .net = type->net != NULL ? net_of : NULL,
                                     .rigid = part_offers_pose(type) ? map_rigid_of : NULL};
    return i;
}

const imp_surface_type *isolate_surface_type(const isolated *i) { return &i->surface_stand_in; }

const imp_map_type *isolate_map_type(const isolated *i) { return &i->map_stand_in; }
