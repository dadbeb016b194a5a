/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/active_callback.h"
#include "core/base/unconst.h"
#include "core/common/clock.h"
#include "core/common/system_error.h"
#include "core/plugin/isolate_internal.h"
#include "core/plugin/value_bytes.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Sends the values in parts; they are used by the REQUEST_CREATE that follows. */
static imp_status send_bytes(isolated *i, const unsigned char *bytes, size_t size)
{
    channel *c = i->worker->channel;
    imp_status status = IMP_STATUS_OK;
    for (size_t at = 0; at < size && status == IMP_STATUS_OK; at += c->work.n) {
        c->work.n = size - at < CHANNEL_BYTES ? size - at : CHANNEL_BYTES;
        memcpy(c->bytes, bytes + at, c->work.n);
        status = worker_request(i->worker, i, REQUEST_VALUES);
    }
    return status;
}

/* Tells the host of the files that create read, as the worker has written their names. False: the
 * host has no memory, or something overwrote the channel. */
static bool tell_files(const channel *c, imp_create_error *why)
{
    const size_t end = c->work.n;
    if (end > CHANNEL_BYTES || (end > 0 && c->bytes[end - 1] != '\0')) return false;
    for (size_t at = 0; at < end && why->reads != NULL;) {
        const char *path = (const char *)c->bytes + at;
        if (!why->reads(why, path)) return false;
        at += strlen(path) + 1;
    }
    return true;
}

static imp_status request_create(isolated *i, const unsigned char *bytes, size_t size, size_t count,
                                 imp_create_error *why)
{
    channel_work *c = &i->worker->channel->work;
    imp_status status = worker_enter(i->worker, i);
    if (status != IMP_STATUS_OK) return status;
    const imp_create_error own = *why;
    c->why = own;
    status = send_bytes(i, bytes, size);
    c->n = count;
    c->limits = i->limits;
    c->end = READING_GOES_ON;
    if (status == IMP_STATUS_OK) status = worker_request(i->worker, i, REQUEST_CREATE);
    *why = c->why;
    why->goes_on = own.goes_on; /* the worker has its own */
    why->reads = own.reads;
    if (status == IMP_STATUS_OK && !tell_files(i->worker->channel, why))
        status = IMP_STATUS_INTERNAL;
    i->end = c->end;
    i->own.self = status == IMP_STATUS_OK ? c->self : NULL;
    memcpy(i->own.lo, c->lo, sizeof i->own.lo);
    memcpy(i->own.hi, c->hi, sizeof i->own.hi);
    i->piece_count = status == IMP_STATUS_OK ? c->pieces : 0;
    worker_leave(i->worker);
    return status;
}

/* Takes `count` pieces from number `first` on, as the channel has them. */
static void take_pieces(isolated *i, size_t first, size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        channel_piece one;
        memcpy(&one, i->worker->channel->bytes + k * sizeof one, sizeof one);
        isolated_piece *piece = &i->pieces[first + k];
        *piece = (isolated_piece){.whole = i, .self = unconst(one.self)};
        memcpy(piece->lo, one.lo, sizeof piece->lo);
        memcpy(piece->hi, one.hi, sizeof piece->hi);
    }
}

/* Asks for all pieces, as many at once as the channel holds; one that is NULL stays without
 * `self`. */
static imp_status request_pieces(isolated *i)
{
    channel_work *c = &i->worker->channel->work;
    imp_status status = worker_enter(i->worker, i);
    if (status != IMP_STATUS_OK) return status;
    for (size_t k = 0; k < i->piece_count && status == IMP_STATUS_OK;) {
        c->self = i->own.self;
        c->n = k;
        c->pieces = i->piece_count;
        status = worker_request(i->worker, i, REQUEST_PIECES);
        if (status != IMP_STATUS_OK) break;
        const size_t left = i->piece_count - k, count = c->pieces < left ? c->pieces : left;
        if (count == 0 || count > CHANNEL_BYTES / sizeof(channel_piece))
            status = IMP_STATUS_INTERNAL; /* something overwrote the channel */
        else
            take_pieces(i, k, count);
        k += count;
    }
    worker_leave(i->worker);
    return status;
}

/* A count that breaks the ABI is the host's to refuse. */
static imp_status create_pieces(isolated *i)
{
    if (i->piece_count == 0 || i->piece_count > IMP_PIECES_MAX) return IMP_STATUS_OK;
    i->pieces = calloc(i->piece_count, sizeof *i->pieces);
    if (i->pieces == NULL) return IMP_STATUS_INTERNAL;
    const imp_status status = request_pieces(i);
    if (status == IMP_STATUS_OK && isolate_is_own_piece(i)) {
        memcpy(i->own.lo, i->pieces[0].lo, sizeof i->own.lo);
        memcpy(i->own.hi, i->pieces[0].hi, sizeof i->own.hi);
    }
    return status;
}

/* For messages: the callback that this thread began last is the one that ended the worker. */
static void name_callback(const isolated *i)
{
    static const char *const names[CALLBACK_COUNT] = {"create", "domain",      "time_domain",
                                                      "span",   "piece_count", "piece"};
    const unsigned last = i->worker != NULL ? atomic_load(&i->worker->channel->callback) : 0;
    const char *type = i->type.surface != NULL ? i->type.surface->name : i->type.map->name;
    active_callback_end(
        active_callback_begin(type, names[last < CALLBACK_COUNT ? last : CALLBACK_CREATE]));
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
    if (status == IMP_STATUS_OK && i->own.self == NULL) return IMP_STATUS_INTERNAL;
    return status == IMP_STATUS_OK ? create_pieces(i) : status;
}

imp_status isolate_create(isolated *i, const imp_value *values, imp_create_error *why)
{
    const double seconds = i->limits.seconds;
    const double before = active_callback_limit(seconds > 0 ? clock_seconds() + seconds : 0);
    const imp_status status = create(i, values, why);
    active_callback_limit(before);
    if (status == SURFACE_LATE) {
        i->end = READING_OUT_OF_TIME;
        return IMP_STATUS_INTERNAL;
    }
    if (status > IMP_STATUS_INTERNAL) name_callback(i);
    return status;
}

void isolate_limit(isolated *i, reading_limits limits) { i->limits = limits; }

reading_end isolate_end(const isolated *i) { return i->end; }

/* There is no one to answer to: the pool keeps what went wrong. */
static void request_destroy(isolated *i)
{
    if (i->own.self == NULL || worker_enter(i->worker, i) != IMP_STATUS_OK) return;
    i->worker->channel->work.self = i->own.self;
    const imp_status end = worker_request(i->worker, i, REQUEST_DESTROY);
    worker_leave(i->worker);
    if (end == SURFACE_CRASHED || end == SURFACE_HUNG) worker_pool_note(i->pool, i->type, end);
}

size_t isolate_bytes(const isolated *i)
{
    return sizeof *i + i->piece_count * sizeof *i->pieces + sizeof *i->ahead;
}

void isolate_destroy(void *self)
{
    isolated *i = self;
    if (i == NULL) return;
    request_destroy(i);
    if (i->worker != NULL) worker_pool_return(i->pool, i->worker);
    free(i->ahead);
    free(i->pieces);
    free(i);
}
