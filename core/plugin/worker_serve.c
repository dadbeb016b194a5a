/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/common/array.h"
#include "core/common/clock.h"
#include "core/plugin/output_guard.h"
#include "core/plugin/value_bytes.h"
#include "core/plugin/worker_internal.h"
#include "core/surface/region.h"
#include "core/surface/surface.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

void *worker_fills(worker_server *s, int k, void *of, size_t size)
{
    return output_guard_lend(&s->out[k], of, size);
}

void worker_take_back(worker_server *s)
{
    for (int k = 0; k < 2; ++k)
        if (!output_guard_take_back(&s->out[k])) abort();
}

void worker_end_copies(const worker_server *s)
{
    if (s->original != NULL ? *s->original == 0 : getpid() != s->process) _exit(1);
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

static imp_status write_formula(worker_server *s)
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

static imp_status destroy(worker_server *s)
{
    if (s->type.surface != NULL)
        s->type.surface->destroy(s->work.self);
    else
        s->type.map->destroy(s->work.self);
    return IMP_STATUS_OK;
}

/* The points, and where they are wanted their errors. */
static double *fills_points(worker_server *s)
{
    return worker_fills(s, 0, s->work.x, 3 * s->work.n * sizeof *s->work.x);
}

static double *fills_errors(worker_server *s)
{
    channel_work *w = &s->work;
    return w->wants_error ? worker_fills(s, 1, w->error, 3 * w->n * sizeof *w->error) : NULL;
}

static imp_status obey_surface(worker_server *s, const imp_surface_type *type)
{
    channel_work *w = &s->work;
    switch (w->request) {
    case REQUEST_EVAL:
        return type->eval(w->self, w->n, w->p, fills_points(s), fills_errors(s));
    case REQUEST_RATE:
        return type->rate(w->self, &w->region, worker_fills(s, 0, &w->rates, sizeof w->rates));
    case REQUEST_NET:
        return type->net(w->self, &w->region, worker_fills(s, 0, &w->net, sizeof w->net));
    case REQUEST_DISTANCE:
        return type->distance(w->self, w->in, worker_fills(s, 0, w->out, sizeof *w->out));
    case REQUEST_SYMMETRY:
        return type->symmetry(w->self, worker_fills(s, 0, &w->symmetry, sizeof w->symmetry));
    case REQUEST_TUBE:
        return type->tube(w->self, &w->region, worker_fills(s, 0, &w->tube, sizeof w->tube));
    default:
        return type->include(w->self, &w->region, worker_fills(s, 0, w->out, sizeof w->out));
    }
}

static imp_status obey_map(worker_server *s, const imp_map_type *type)
{
    channel_work *w = &s->work;
    switch (w->request) {
    case REQUEST_EVAL:
        return type->eval(w->self, w->n, w->p, fills_points(s), fills_errors(s));
    case REQUEST_RATE:
        return type->rate(w->self, &w->box, worker_fills(s, 0, &w->map_rates, sizeof w->map_rates));
    case REQUEST_NET:
        return type->net(w->self, &w->region, worker_fills(s, 0, &w->net, sizeof w->net));
    case REQUEST_POSE:
        return type->rigid(w->self, &w->in[3], worker_fills(s, 0, &w->pose, sizeof w->pose));
    default:
        return type->apply(w->self, w->in, worker_fills(s, 0, w->out, sizeof w->out));
    }
}

_Static_assert(sizeof(imp_net) <= OUTPUT_GUARD_MOST && sizeof(imp_pose) <= OUTPUT_GUARD_MOST &&
                   sizeof(((channel_work *)0)->x) <= OUTPUT_GUARD_MOST,
               "room for all that callbacks fill");

static imp_status obey(worker_server *s)
{
    switch (s->work.request) {
    case REQUEST_VALUES:
        return worker_receive(s);
    case REQUEST_CREATE:
        return worker_create(s);
    case REQUEST_PIECES:
        return worker_pieces(s);
    case REQUEST_INCLUDE_PIECES:
        return worker_include_pieces(s);
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
    worker_server s = {.with = c,
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
        worker_take_back(&s);
        s.work.status = fp_mode_kept(mode) ? status : SURFACE_CHANGED_MODE;
        c->work = s.work;
        atomic_store(&c->answering, c->number);
        sem_post(&c->replied);
    }
}
