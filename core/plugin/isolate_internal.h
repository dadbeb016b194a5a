/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_ISOLATE_INTERNAL_H
#define CORE_PLUGIN_ISOLATE_INTERNAL_H

#include "core/plugin/isolate.h"

/* The inside of an isolated instance
 * ==================================
 * For its three files: isolate.c creates and destroys it; isolate_stand_in.c is what the rest of
 * core takes for its type; isolate_ahead.c asks for models of many pieces at once. */

/* The models of some pieces over their domains and a span of times, which came with those of the
 * piece before them: who asks for one after the other, as hierarchies do, would wait for a reply to
 * each. The lock of the worker guards it. */
typedef struct inclusions_ahead {
    size_t first, count;
    double times[2];
    channel_inclusion at[CHANNEL_BYTES / sizeof(channel_inclusion)];
} inclusions_ahead;

/* One surface or map, as the rest of core sees it: what it takes for the plugin's `self`. Meshes
 * have millions, so that it is small. */
typedef struct isolated_piece {
    isolated *whole;     /* whose requests they are */
    void *self;          /* as the worker knows it; NULL: not created */
    double lo[3], hi[3]; /* domain; a map: times in [0], span in [1] */
} isolated_piece;

struct isolated {
    isolated_piece own; /* the instance itself: first, so that both have one address */
    worker_type type;
    imp_surface_type surface_stand_in; /* one of the two is in use */
    imp_map_type map_stand_in;
    worker_pool *pool;
    worker *worker;         /* NULL: could not start */
    isolated_piece *pieces; /* piece_count of them, unless that breaks the ABI; or NULL */
    size_t piece_count;
    reading_limits limits;   /* of create */
    reading_end end;         /* which of them create has reached */
    inclusions_ahead *ahead; /* of the pieces; NULL: none was asked for yet */
};

/* Whether the instance is its own only piece: one surface. */
static inline bool isolate_is_own_piece(const isolated *i)
{
    return i->piece_count == 1 && i->pieces != NULL && i->pieces[0].self == i->own.self;
}

/* Takes the model of a piece from those that came ahead. *done false: there is none, ask for it
 * alone. The worker has been entered. */
imp_status isolate_include_ahead(isolated_piece *piece, const imp_region *region,
                                 imp_model model[3], bool *done);

#endif
