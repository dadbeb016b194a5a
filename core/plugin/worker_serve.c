/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/common/array.h"
#include "core/common/clock.h"
#include "core/plugin/output_guard.h"
#include "core/plugin/value_bytes.h"
#include "core/plugin/worker.h"
#include "core/surface/region.h"
#include "core/surface/surface.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

/* What the worker keeps between requests: the bytes of values that have come so far. And what it
 * works on: a copy made by a callback that forks goes on to write what that callback is to
 * answer. */
typedef struct server {
    channel *with;
    channel_work work;
    worker_type type;
    pid_t process;
    const volatile unsigned char *original; /* not 0 in this process, 0 in its copies; or NULL */
    unsigned char *bytes;
    size_t length, capacity;
    output_guard out[2]; /* what the callback that is called fills */
} server;

/* Memory that a callback fills in the place of `of`. */
static void *fills(server *s, int k, void *of, size_t size)
{
    return output_guard_lend(&s->out[k], of, size);
}

/* A callback that wrote before what it fills ends as one that wrote past the end does. */
static void take_back(server *s)
{
    for (int k = 0; k < 2; ++k)
        if (!output_guard_take_back(&s->out[k])) abort();
}

/* Returns a byte that the kernel clears in copies of this process, which is read faster than the
 * number of the process is asked for; NULL: the kernel has none. */
static const volatile unsigned char *mark_original(void)
{
    const size_t size = (size_t)sysconf(_SC_PAGESIZE);
    unsigned char *page =
        mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (page == MAP_FAILED) return NULL;
    *page = 1;
    if (madvise(page, size, MADV_WIPEONFORK) == 0) return page;
    munmap(page, size);
    return NULL;
}

/* Only the worker itself goes on after a callback. */
static void end_copies(const server *s)
{
    if (s->original != NULL ? *s->original == 0 : getpid() != s->process) _exit(1);
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

static void domain(server *s, const void *instance)
{
    channel_work *w = &s->work;
    s->type.surface->domain(instance, fills(s, 0, w->lo, sizeof w->lo),
                            fills(s, 1, w->hi, sizeof w->hi));
    take_back(s);
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

static imp_status create_with(server *s, const imp_value *values)
{
    channel_work *w = &s->work;
    const worker_type type = s->type;
    begin(s, CALLBACK_CREATE);
    w->why.goes_on = goes_on;
    if (w->limits.seconds > 0) w->limits.seconds += clock_thread_seconds();
    const imp_status status = type.surface != NULL ? type.surface->create(values, &w->self, &w->why)
                                                   : type.map->create(values, &w->self, &w->why);
    if (status != IMP_STATUS_OK || w->self == NULL) return status;
    if (type.surface == NULL) {
        begin(s, CALLBACK_TIME_DOMAIN);
        type.map->time_domain(w->self, fills(s, 0, &w->lo[0], sizeof w->lo[0]),
                              fills(s, 1, &w->hi[0], sizeof w->hi[0]));
        take_back(s);
        if (!IMP_OFFERS(type.map, span)) return IMP_STATUS_OK;
        begin(s, CALLBACK_SPAN);
        type.map->span(w->self, fills(s, 0, &w->lo[1], sizeof w->lo[1]),
                       fills(s, 1, &w->hi[1], sizeof w->hi[1]));
        take_back(s);
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

static const void *piece(server *s, size_t k)
{
    begin(s, CALLBACK_PIECE);
    const void *made = s->type.surface->piece(s->work.self, k);
    end_copies(s);
    return made;
}

static imp_status pieces(server *s)
{
    channel_work *w = &s->work;
    const batch b = begin_batch(w, sizeof(channel_piece));
    size_t done = 0;
    for (; done < b.most && has_time(&b, done); ++done) {
        channel_piece one = {.self = piece(s, w->n + done)};
        if (one.self != NULL) {
            begin(s, CALLBACK_DOMAIN);
            domain(s, one.self);
            end_copies(s);
            memcpy(one.lo, w->lo, sizeof one.lo);
            memcpy(one.hi, w->hi, sizeof one.hi);
        }
        memcpy(s->with->bytes + done * sizeof one, &one, sizeof one);
    }
    w->pieces = done;
    return IMP_STATUS_OK;
}

/* Each over its whole domain at the times of the region that was sent. */
static imp_status include_pieces(server *s)
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
        one.status = s->type.surface->include(self, &region, fills(s, 0, w->out, sizeof w->out));
        end_copies(s);
        take_back(s);
        memcpy(one.model, w->out, sizeof one.model);
        memcpy(s->with->bytes + done * sizeof one, &one, sizeof one);
    }
    w->pieces = done;
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

/* --- Formulas --------------------------------------------------------------------------------- */

/* What the callback prints, of which only a part fits into the channel. */
typedef struct text_window {
    unsigned char *bytes;
    size_t from, length;
} text_window;

static void add_to_window(const imp_text_sink *sink, const char *text, size_t size)
{
    text_window *w = sink->host;
    for (size_t k = 0; k < size; ++k, ++w->length)
        if (w->length >= w->from && w->length - w->from < CHANNEL_BYTES)
            w->bytes[w->length - w->from] = (unsigned char)text[k];
}

static imp_status write_formula(server *s)
{
    channel_work *w = &s->work;
    text_window window = {s->with->bytes, w->n, 0};
    const imp_text_sink sink = {.struct_size = sizeof sink, .host = &window, .add = add_to_window};
    const imp_status status = s->type.surface != NULL
                                  ? s->type.surface->write_formula(w->self, &sink)
                                  : s->type.map->write_formula(w->self, &sink);
    w->n = window.length;
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

/* The points, and where they are wanted their errors. */
static double *fills_points(server *s)
{
    return fills(s, 0, s->work.x, 3 * s->work.n * sizeof *s->work.x);
}

static double *fills_errors(server *s)
{
    channel_work *w = &s->work;
    return w->wants_error ? fills(s, 1, w->error, 3 * w->n * sizeof *w->error) : NULL;
}

static imp_status obey_surface(server *s, const imp_surface_type *type)
{
    channel_work *w = &s->work;
    switch (w->request) {
    case REQUEST_EVAL:
        return type->eval(w->self, w->n, w->p, fills_points(s), fills_errors(s));
    case REQUEST_RATE:
        return type->rate(w->self, &w->region, fills(s, 0, &w->rates, sizeof w->rates));
    case REQUEST_NET:
        return type->net(w->self, &w->region, fills(s, 0, &w->net, sizeof w->net));
    case REQUEST_DISTANCE:
        return type->distance(w->self, w->in, fills(s, 0, w->out, sizeof *w->out));
    case REQUEST_SYMMETRY:
        return type->symmetry(w->self, fills(s, 0, &w->symmetry, sizeof w->symmetry));
    default:
        return type->include(w->self, &w->region, fills(s, 0, w->out, sizeof w->out));
    }
}

static imp_status obey_map(server *s, const imp_map_type *type)
{
    channel_work *w = &s->work;
    switch (w->request) {
    case REQUEST_EVAL:
        return type->eval(w->self, w->n, w->p, fills_points(s), fills_errors(s));
    case REQUEST_RATE:
        return type->rate(w->self, &w->box, fills(s, 0, &w->map_rates, sizeof w->map_rates));
    case REQUEST_NET:
        return type->net(w->self, &w->region, fills(s, 0, &w->net, sizeof w->net));
    case REQUEST_POSE:
        return type->rigid(w->self, &w->in[3], fills(s, 0, &w->pose, sizeof w->pose));
    default:
        return type->apply(w->self, w->in, fills(s, 0, w->out, sizeof w->out));
    }
}

_Static_assert(sizeof(imp_net) <= OUTPUT_GUARD_MOST && sizeof(imp_pose) <= OUTPUT_GUARD_MOST &&
                   sizeof(((channel_work *)0)->x) <= OUTPUT_GUARD_MOST,
               "room for all that callbacks fill");

static imp_status obey(server *s)
{
    switch (s->work.request) {
    case REQUEST_VALUES:
        return receive(s);
    case REQUEST_CREATE:
        return create(s);
    case REQUEST_PIECES:
        return pieces(s);
    case REQUEST_INCLUDE_PIECES:
        return include_pieces(s);
    case REQUEST_FORMULA:
        return write_formula(s);
    case REQUEST_DESTROY:
        return destroy(s);
    default:
        return s->type.surface != NULL ? obey_surface(s, s->type.surface)
                                       : obey_map(s, s->type.map);
    }
}

void worker_serve(channel *c, worker_type type)
{
    const fp_mode mode = fp_mode_read();
    server s = {.with = c,
                .type = type,
                .process = getpid(),
                .original = mark_original(),
                .out = {output_guard_make(), output_guard_make()}};
    for (;;) {
        while (sem_wait(&c->requested) != 0)
            if (errno != EINTR) _exit(1);
        s.work = c->work;
        const imp_status status = obey(&s);
        if (getpid() != s.process) _exit(1); /* a copy by vfork shares the byte, too */
        take_back(&s);
        s.work.status = fp_mode_kept(mode) ? status : SURFACE_CHANGED_MODE;
        c->work = s.work;
        atomic_store(&c->answering, c->number);
        sem_post(&c->replied);
    }
}
