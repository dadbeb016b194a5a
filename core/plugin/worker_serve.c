/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/common/array.h"
#include "core/plugin/value_bytes.h"
#include "core/plugin/worker.h"
#include "core/surface/surface.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* What the worker keeps between requests: the bytes of values that have come so far. */
typedef struct received {
    unsigned char *bytes;
    size_t length, capacity;
} received;

static imp_status out_of_memory(channel *c)
{
    snprintf(c->why.text, sizeof c->why.text, "out of memory in the process that isolates it");
    return IMP_INTERNAL;
}

static imp_status receive(channel *c, received *r)
{
    while (r->bytes == NULL || r->capacity < r->length + c->n) {
        unsigned char *grown = array_reserve(r->bytes, r->length + c->n, &r->capacity, 1);
        if (grown == NULL) return out_of_memory(c);
        r->bytes = grown;
    }
    memcpy(r->bytes + r->length, c->bytes, c->n);
    r->length += c->n;
    return IMP_OK;
}

static imp_status create_with(channel *c, worker_type type, const imp_value *values)
{
    atomic_store(&c->callback, CALLBACK_CREATE);
    const imp_status status = type.surface != NULL ? type.surface->create(values, &c->self, &c->why)
                                                   : type.map->create(values, &c->self, &c->why);
    if (status != IMP_OK || c->self == NULL) return status;
    if (type.surface == NULL) {
        atomic_store(&c->callback, CALLBACK_TIME_DOMAIN);
        type.map->time_domain(c->self, &c->lo[0], &c->hi[0]);
    } else if (part_offers_pieces(type.surface)) {
        atomic_store(&c->callback, CALLBACK_PIECE_COUNT);
        c->pieces = type.surface->piece_count(c->self);
    } else {
        atomic_store(&c->callback, CALLBACK_DOMAIN);
        type.surface->domain(c->self, c->lo, c->hi);
    }
    return IMP_OK;
}

static imp_status piece(channel *c, const imp_surface_type *type)
{
    atomic_store(&c->callback, CALLBACK_PIECE);
    c->piece = type->piece(c->self, c->n);
    if (c->piece == NULL) return IMP_OK;
    atomic_store(&c->callback, CALLBACK_DOMAIN);
    type->domain(c->piece, c->lo, c->hi);
    return IMP_OK;
}

static imp_status create(channel *c, worker_type type, received *r)
{
    imp_value *values = c->n > 0 ? value_bytes_read(r->bytes, c->n) : NULL;
    imp_status status = c->n == 0 || values != NULL ? IMP_OK : out_of_memory(c);
    c->self = NULL;
    c->pieces = 0;
    if (status == IMP_OK) status = create_with(c, type, values);
    free(values);
    free(r->bytes);
    *r = (received){NULL, 0, 0};
    return status;
}

static imp_status destroy(channel *c, worker_type type)
{
    if (type.surface != NULL)
        type.surface->destroy(c->self);
    else
        type.map->destroy(c->self);
    return IMP_OK;
}

static imp_status obey_surface(channel *c, const imp_surface_type *type)
{
    double *error = c->wants_error ? c->error : NULL;
    if (c->request == REQUEST_EVAL) return type->eval(c->self, c->n, c->p, c->x, error);
    if (c->request == REQUEST_RATE) return type->rate(c->self, &c->region, &c->rates);
    if (c->request == REQUEST_NET) return type->net(c->self, &c->region, &c->net);
    if (c->request == REQUEST_DISTANCE) return type->distance(c->self, c->in, c->out);
    return type->include(c->self, &c->region, c->out);
}

static imp_status obey_map(channel *c, const imp_map_type *type)
{
    double *error = c->wants_error ? c->error : NULL;
    if (c->request == REQUEST_EVAL) return type->eval(c->self, c->n, c->p, c->x, error);
    if (c->request == REQUEST_RATE) return type->rate(c->self, &c->box, &c->map_rates);
    if (c->request == REQUEST_NET) return type->net(c->self, &c->region, &c->net);
    if (c->request == REQUEST_POSE) return type->rigid(c->self, &c->in[3], &c->pose);
    return type->apply(c->self, c->in, c->out);
}

static imp_status obey(channel *c, worker_type type, received *r)
{
    switch (c->request) {
    case REQUEST_VALUES:
        return receive(c, r);
    case REQUEST_CREATE:
        return create(c, type, r);
    case REQUEST_PIECE:
        return piece(c, type.surface);
    case REQUEST_DESTROY:
        return destroy(c, type);
    default:
        return type.surface != NULL ? obey_surface(c, type.surface) : obey_map(c, type.map);
    }
}

/* A callback may have forked, and then returns here twice: only the worker itself replies. */
void worker_serve(channel *c, worker_type type)
{
    const pid_t self = getpid();
    const fp_mode mode = fp_mode_read();
    received values = {NULL, 0, 0};
    for (;;) {
        while (sem_wait(&c->requested) != 0)
            if (errno != EINTR) _exit(1);
        const uint64_t number = c->number;
        const imp_status status = obey(c, type, &values);
        if (getpid() != self) _exit(1);
        c->status = fp_mode_kept(mode) ? status : SURFACE_CHANGED_MODE;
        atomic_store(&c->answering, number);
        sem_post(&c->replied);
    }
}
