/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/plugin/isolate_internal.h"

/* Whether the region is the whole domain of the piece, at some times. */
static bool is_whole(const isolated_piece *piece, const imp_region *region)
{
    return memcmp(piece->lo, region->lo, 2 * sizeof *piece->lo) == 0 &&
           memcmp(piece->hi, region->hi, 2 * sizeof *piece->hi) == 0;
}

/* Asks for the models of piece k and of those after it. */
static imp_status look_ahead(isolated *whole, size_t k, const imp_region *region)
{
    inclusions_ahead *a = whole->ahead;
    channel *with = whole->worker->channel;
    channel_work *c = &with->work;
    c->self = whole->own.self;
    c->n = k;
    c->pieces = whole->piece_count;
    c->region = *region;
    const imp_status status = worker_request(whole->worker, whole, REQUEST_INCLUDE_PIECES);
    const size_t most = sizeof a->at / sizeof *a->at;
    a->first = k;
    a->count = status == IMP_STATUS_OK && c->pieces <= most ? c->pieces : 0;
    a->times[0] = region->lo[2];
    a->times[1] = region->hi[2];
    memcpy(a->at, with->bytes, a->count * sizeof *a->at);
    return status;
}

imp_status isolate_include_ahead(isolated_piece *piece, const imp_region *region,
                                 imp_model model[3], bool *done)
{
    isolated *whole = piece->whole;
    *done = false;
    if (&whole->own == piece || !is_whole(piece, region)) return IMP_STATUS_OK;
    const size_t k = (size_t)(piece - whole->pieces);
    if (whole->ahead == NULL) whole->ahead = calloc(1, sizeof *whole->ahead);
    inclusions_ahead *a = whole->ahead;
    if (a == NULL) return IMP_STATUS_OK;
    const bool same =
        memcmp(a->times, (double[]){region->lo[2], region->hi[2]}, sizeof a->times) == 0;
    const bool follows = k == 0 || (same && k == a->first + a->count);
    imp_status status = IMP_STATUS_OK;
    if (!(same && k >= a->first && k - a->first < a->count)) {
        if (!follows) return IMP_STATUS_OK;
        status = look_ahead(whole, k, region);
    }
    *done = status != IMP_STATUS_OK || a->count > 0;
    if (status != IMP_STATUS_OK || a->count == 0) return status;
    memcpy(model, a->at[k - a->first].model, 3 * sizeof *model);
    return a->at[k - a->first].status;
}
