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

/* What the worker keeps between requests: the bytes of values that have come so far. And what it
 * works on: a copy made by a callback that forks goes on to write what that callback is to
 * answer. */
typedef struct server {
    channel *with;
    channel_work work;
    worker_type type;
    pid_t process;
    unsigned char *bytes;
    size_t length, capacity;
} server;

/* Only the worker itself goes on after a callback. */
static void end_copies(const server *s)
{
    if (getpid() != s->process) _exit(1);
}

static void begin(const server *s, channel_callback what)
{
    end_copies(s);
    atomic_store(&s->with->callback, what);
}

static imp_status out_of_memory(channel_work *w)
{
    snprintf(w->why.text, sizeof w->why.text, "out of memory in the process that isolates it");
    return IMP_STATUS_INTERNAL;
}

static imp_status receive(server *s)
{
    channel_work *w = &s->work;
    while (s->bytes == NULL || s->capacity < s->length + w->n) {
        unsigned char *grown = array_reserve(s->bytes, s->length + w->n, &s->capacity, 1);
        if (grown == NULL) return out_of_memory(w);
        s->bytes = grown;
    }
    memcpy(s->bytes + s->length, s->with->bytes, w->n);
    s->length += w->n;
    return IMP_STATUS_OK;
}

static imp_status create_with(server *s, const imp_value *values)
{
    channel_work *w = &s->work;
    const worker_type type = s->type;
    begin(s, CALLBACK_CREATE);
    const imp_status status = type.surface != NULL ? type.surface->create(values, &w->self, &w->why)
                                                   : type.map->create(values, &w->self, &w->why);
    if (status != IMP_STATUS_OK || w->self == NULL) return status;
    if (type.surface == NULL) {
        begin(s, CALLBACK_TIME_DOMAIN);
        type.map->time_domain(w->self, &w->lo[0], &w->hi[0]);
        if (!IMP_OFFERS(type.map, span)) return IMP_STATUS_OK;
        begin(s, CALLBACK_SPAN);
        type.map->span(w->self, &w->lo[1], &w->hi[1]);
    } else if (IMP_OFFERS(type.surface, piece)) {
        begin(s, CALLBACK_PIECE_COUNT);
        w->pieces = type.surface->piece_count(w->self);
    } else {
        begin(s, CALLBACK_DOMAIN);
        type.surface->domain(w->self, w->lo, w->hi);
    }
    return IMP_STATUS_OK;
}

static imp_status piece(server *s)
{
    channel_work *w = &s->work;
    begin(s, CALLBACK_PIECE);
    w->piece = s->type.surface->piece(w->self, w->n);
    if (w->piece == NULL) return IMP_STATUS_OK;
    begin(s, CALLBACK_DOMAIN);
    s->type.surface->domain(w->piece, w->lo, w->hi);
    return IMP_STATUS_OK;
}

static imp_status create(server *s)
{
    channel_work *w = &s->work;
    imp_value *values = w->n > 0 ? value_bytes_read(s->bytes, w->n) : NULL;
    imp_status status = w->n == 0 || values != NULL ? IMP_STATUS_OK : out_of_memory(w);
    w->self = NULL;
    w->pieces = 0;
    if (status == IMP_STATUS_OK) status = create_with(s, values);
    free(values);
    free(s->bytes);
    s->bytes = NULL;
    s->length = s->capacity = 0;
    return status;
}

static imp_status destroy(server *s)
{
    if (s->type.surface != NULL)
        s->type.surface->destroy(s->work.self);
    else
        s->type.map->destroy(s->work.self);
    return IMP_STATUS_OK;
}

static imp_status obey_surface(channel_work *w, const imp_surface_type *type)
{
    double *error = w->wants_error ? w->error : NULL;
    if (w->request == REQUEST_EVAL) return type->eval(w->self, w->n, w->p, w->x, error);
    if (w->request == REQUEST_RATE) return type->rate(w->self, &w->region, &w->rates);
    if (w->request == REQUEST_NET) return type->net(w->self, &w->region, &w->net);
    if (w->request == REQUEST_DISTANCE) return type->distance(w->self, w->in, w->out);
    if (w->request == REQUEST_SYMMETRY) return type->symmetry(w->self, &w->symmetry);
    return type->include(w->self, &w->region, w->out);
}

static imp_status obey_map(channel_work *w, const imp_map_type *type)
{
    double *error = w->wants_error ? w->error : NULL;
    if (w->request == REQUEST_EVAL) return type->eval(w->self, w->n, w->p, w->x, error);
    if (w->request == REQUEST_RATE) return type->rate(w->self, &w->box, &w->map_rates);
    if (w->request == REQUEST_NET) return type->net(w->self, &w->region, &w->net);
    if (w->request == REQUEST_POSE) return type->rigid(w->self, &w->in[3], &w->pose);
    return type->apply(w->self, w->in, w->out);
}

static imp_status obey(server *s)
{
    switch (s->work.request) {
    case REQUEST_VALUES:
        return receive(s);
    case REQUEST_CREATE:
        return create(s);
    case REQUEST_PIECE:
        return piece(s);
    case REQUEST_DESTROY:
        return destroy(s);
    default:
        return s->type.surface != NULL ? obey_surface(&s->work, s->type.surface)
                                       : obey_map(&s->work, s->type.map);
    }
}

void worker_serve(channel *c, worker_type type)
{
    const fp_mode mode = fp_mode_read();
    server s = {.with = c, .type = type, .process = getpid()};
    for (;;) {
        while (sem_wait(&c->requested) != 0)
            if (errno != EINTR) _exit(1);
        s.work = c->work;
        const imp_status status = obey(&s);
        end_copies(&s);
        s.work.status = fp_mode_kept(mode) ? status : SURFACE_CHANGED_MODE;
        c->work = s.work;
        atomic_store(&c->answering, c->number);
        sem_post(&c->replied);
    }
}
