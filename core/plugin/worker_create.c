/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/array.h"
#include "core/common/clock.h"
#include "core/plugin/value_bytes.h"
#include "core/plugin/worker_internal.h"
#include "core/surface/region.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The worker creates an instance from the values that have come, and tells of its pieces. */

static void begin(const worker_server *s, channel_callback what)
{
    worker_end_copies(s);
    atomic_store(&s->with->callback, what);
}

static imp_status out_of_memory(channel_work *w)
{
    snprintf(w->why.text, sizeof w->why.text, "out of memory in the process that isolates it");
    return IMP_STATUS_INTERNAL;
}

imp_status worker_receive(worker_server *s)
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

static void domain(worker_server *s, const void *instance)
{
    channel_work *w = &s->work;
    s->type.surface->domain(instance, worker_fills(s, 0, w->lo, sizeof w->lo),
                            worker_fills(s, 1, w->hi, sizeof w->hi));
    worker_take_back(s);
}

/* What create asks (imp_create_error.goes_on); the limit on seconds is a time of the clock here. */
static int goes_on(imp_create_error *why, uint64_t bytes)
{
    channel_work *w = (channel_work *)(void *)((char *)why - offsetof(channel_work, why));
    if (w->limits.bytes > 0 && bytes > w->limits.bytes) w->end = READING_OUT_OF_ROOM;
    if (w->limits.seconds > 0 && clock_thread_seconds() > w->limits.seconds)
        w->end = READING_OUT_OF_TIME;
    return w->end == READING_GOES_ON;
}

/* What create tells (imp_create_error.reads): the names go back through the channel. */
static int reads(imp_create_error *why, const char *path)
{
    worker_server *s = (worker_server *)(void *)((char *)why - offsetof(worker_server, work) -
                                                 offsetof(channel_work, why));
    const size_t size = path != NULL ? strlen(path) + 1 : 0;
    if (size == 0 || size > CHANNEL_BYTES - s->work.n) return 0;
    memcpy(s->with->bytes + s->work.n, path, size);
    s->work.n += size;
    return 1;
}

static imp_status create_with(worker_server *s, const imp_value *values)
{
    channel_work *w = &s->work;
    const worker_type type = s->type;
    begin(s, CALLBACK_CREATE);
    w->why.goes_on = goes_on;
    w->why.reads = reads;
    if (w->limits.seconds > 0) w->limits.seconds += clock_thread_seconds();
    const imp_status status = type.surface != NULL ? type.surface->create(values, &w->self, &w->why)
                                                   : type.map->create(values, &w->self, &w->why);
    if (status != IMP_STATUS_OK || w->self == NULL) return status;
    if (type.surface == NULL) {
        begin(s, CALLBACK_TIME_DOMAIN);
        type.map->time_domain(w->self, worker_fills(s, 0, &w->lo[0], sizeof w->lo[0]),
                              worker_fills(s, 1, &w->hi[0], sizeof w->hi[0]));
        worker_take_back(s);
        if (!IMP_OFFERS(type.map, span)) return IMP_STATUS_OK;
        begin(s, CALLBACK_SPAN);
        type.map->span(w->self, worker_fills(s, 0, &w->lo[1], sizeof w->lo[1]),
                       worker_fills(s, 1, &w->hi[1], sizeof w->hi[1]));
        worker_take_back(s);
    } else if (IMP_OFFERS(type.surface, piece)) {
        begin(s, CALLBACK_PIECE_COUNT);
        w->pieces = type.surface->piece_count(w->self);
    } else {
        begin(s, CALLBACK_DOMAIN);
        domain(s, w->self);
    }
    return IMP_STATUS_OK;
}

/* The pieces that there is room and time for. */
typedef struct batch {
    size_t most;
    double until;
} batch;

static batch begin_batch(const channel_work *w, size_t size)
{
    const size_t left = w->n < w->pieces ? w->pieces - w->n : 0, room = CHANNEL_BYTES / size;
    return (batch){left < room ? left : room, clock_seconds() + CHANNEL_BATCH_S};
}

static bool has_time(const batch *b, size_t done)
{
    return done == 0 || clock_seconds() < b->until;
}

static const void *piece(worker_server *s, size_t k)
{
    begin(s, CALLBACK_PIECE);
    const void *made = s->type.surface->piece(s->work.self, k);
    worker_end_copies(s);
    return made;
}

imp_status worker_pieces(worker_server *s)
{
    channel_work *w = &s->work;
    const batch b = begin_batch(w, sizeof(channel_piece));
    size_t done = 0;
    for (; done < b.most && has_time(&b, done); ++done) {
        channel_piece one = {.self = piece(s, w->n + done)};
        if (one.self != NULL) {
            begin(s, CALLBACK_DOMAIN);
            domain(s, one.self);
            worker_end_copies(s);
            memcpy(one.lo, w->lo, sizeof one.lo);
            memcpy(one.hi, w->hi, sizeof one.hi);
        }
        memcpy(s->with->bytes + done * sizeof one, &one, sizeof one);
    }
    w->pieces = done;
    return IMP_STATUS_OK;
}

/* Each over its whole domain at the times of the region that was sent. */
imp_status worker_include_pieces(worker_server *s)
{
    channel_work *w = &s->work;
    const batch b = begin_batch(w, sizeof(channel_inclusion));
    const double times[2] = {w->region.lo[2], w->region.hi[2]};
    size_t done = 0;
    for (; done < b.most && has_time(&b, done); ++done) {
        channel_inclusion one = {.status = IMP_STATUS_OK};
        const void *self = piece(s, w->n + done);
        domain(s, self);
        w->lo[2] = times[0], w->hi[2] = times[1];
        const imp_region region = region_make(w->lo, w->hi);
        one.status =
            s->type.surface->include(self, &region, worker_fills(s, 0, w->out, sizeof w->out));
        worker_end_copies(s);
        worker_take_back(s);
        memcpy(one.model, w->out, sizeof one.model);
        memcpy(s->with->bytes + done * sizeof one, &one, sizeof one);
    }
    w->pieces = done;
    return IMP_STATUS_OK;
}

imp_status worker_create(worker_server *s)
{
    channel_work *w = &s->work;
    imp_value *values = w->n > 0 ? value_bytes_read(s->bytes, w->n) : NULL;
    imp_status status = w->n == 0 || values != NULL ? IMP_STATUS_OK : out_of_memory(w);
    w->self = NULL;
    w->pieces = 0;
    w->n = 0;
    if (status == IMP_STATUS_OK) status = create_with(s, values);
    free(values);
    free(s->bytes);
    s->bytes = NULL;
    s->length = s->capacity = 0;
    return status;
}
