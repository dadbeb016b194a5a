/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ISOLATE_INTERNAL_H
#define CORE_PLUGIN_ISOLATE_INTERNAL_H

#include "core/plugin/isolate.h"

/* The inside of an isolated instance
 * ==================================
 * For its two files: isolate.c creates and destroys it; isolate_stand_in.c is what the rest of core
 * takes for its type. */

/* The models of some pieces over their domains and a span of times, which came with those of the
 * piece before them: who asks for one after the other, as hierarchies do, would wait for a reply to
 * each. The lock of the worker guards it. */
typedef struct inclusions_ahead {
    size_t first, count;
    double times[2];
    channel_inclusion at[CHANNEL_BYTES / sizeof(channel_inclusion)];
} inclusions_ahead;

struct isolated {
    worker_type type;
    imp_surface_type surface_stand_in; /* one of the two is in use */
    imp_map_type map_stand_in;
    worker_pool *pool;
    worker *worker;      /* NULL: could not start */
    void *self;          /* the instance, as the worker knows it; NULL: not created */
    const void *user;    /* whose requests they are: itself, or what it is a piece of */
    double lo[3], hi[3]; /* domain; a map: times in [0], span in [1] */
    isolated *pieces;    /* piece_count of them, unless that breaks the ABI; or NULL */
    size_t piece_count;
    inclusions_ahead *ahead; /* of the pieces; NULL: none was asked for yet */
};

/* Whether the instance is its own only piece: one surface. */
static inline bool isolate_is_own_piece(const isolated *i)
{
    return i->piece_count == 1 && i->pieces != NULL && i->pieces[0].self == i->self;
}

#endif
