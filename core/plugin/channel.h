/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_CHANNEL_H
#define CORE_PLUGIN_CHANNEL_H

#include <semaphore.h>
#include <stdatomic.h>

#include "core/plugin/reading_limits.h"

#include <impinge/surface.h>

/* The memory that the host shares with a worker
 * =============================================
 * The host writes a request and its number and posts `requested`; the worker works on a copy of its
 * own, writes the reply, copies the number and posts `replied`. Only one of the two uses the
 * channel at a time, also where a callback forks, and its copy goes on to write. A reply counts
 * only if it carries the number of the request that the host waits for. */

enum {
    CHANNEL_POINTS = 64,     /* of one REQUEST_EVAL */
    CHANNEL_BYTES = 1 << 16, /* of one REQUEST_VALUES */
};

/* What a request about many pieces may take before it is answered for those that are done, so that
 * slow callbacks do not look like one that hangs. */
#define CHANNEL_BATCH_S 0.1

typedef enum channel_request {
    REQUEST_VALUES, /* bytes: the next part of the parameter values for REQUEST_CREATE */
    REQUEST_CREATE,
    REQUEST_PIECES,         /* of `self`, from number n on: bytes, as channel_piece */
    REQUEST_INCLUDE_PIECES, /* over their domains at region's times: bytes, as channel_inclusion */
    REQUEST_EVAL,
    REQUEST_RATE,
    REQUEST_INCLUDE, /* a map: apply */
    REQUEST_NET,
    REQUEST_POSE, /* of a map over the times of in[3] */
    REQUEST_DISTANCE,
    REQUEST_SYMMETRY,
    REQUEST_TUBE,
    REQUEST_FORMULA, /* from byte number n on: bytes, and n of the whole text */
    REQUEST_DESTROY
} channel_request;

/* One of many pieces. */
typedef struct channel_piece {
    const void *self;    /* as the worker knows it, or NULL */
    double lo[3], hi[3]; /* domain */
} channel_piece;

typedef struct channel_inclusion {
    imp_status status;
    imp_model model[3];
} channel_inclusion;

/* What REQUEST_CREATE and REQUEST_PIECES run, one after the other. */
typedef enum channel_callback {
    CALLBACK_CREATE,
    CALLBACK_DOMAIN,
    CALLBACK_TIME_DOMAIN,
    CALLBACK_SPAN,
    CALLBACK_PIECE_COUNT,
    CALLBACK_PIECE,
    CALLBACK_COUNT
} channel_callback;

/* What requests and replies consist of. */
typedef struct channel_work {
    channel_request request;
    void *self; /* the instance, as the worker knows it: set by REQUEST_CREATE */
    imp_status status;
    imp_create_error why;
    reading_limits limits; /* of REQUEST_CREATE */
    reading_end end;       /* set by REQUEST_CREATE: which of them ended it */
    size_t
        pieces; /* set by REQUEST_CREATE of a type that has them, else 0; how many are in bytes */
    double lo[3], hi[3]; /* domain, after REQUEST_CREATE; a map: times in [0], span in [1] */
    size_t n; /* points; of REQUEST_VALUES: bytes; of REQUEST_CREATE: values, and back from it bytes
                 of names of files that it read, each NUL-terminated; the first piece */
    int wants_error;
    double p[4 * CHANNEL_POINTS], x[3 * CHANNEL_POINTS], error[3 * CHANNEL_POINTS];
    imp_region region;
    imp_box4 box;
    imp_rate_matrix rates;
    imp_map_rates map_rates;
    imp_model in[4], out[3];
    imp_net net; /* a map: also what it is given */
    imp_pose pose;
    imp_symmetry symmetry;
    imp_tube tube;
} channel_work;

typedef struct channel {
    sem_t requested, replied;
    uint64_t number;            /* of the request */
    _Atomic uint64_t answering; /* number of the request that was answered last */
    _Atomic unsigned callback;  /* channel_callback that was begun last */
    channel_work work;
    unsigned char bytes[CHANNEL_BYTES];
} channel;

#endif
