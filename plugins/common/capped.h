/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_COMMON_CAPPED_H
#define PLUGINS_COMMON_CAPPED_H

#include <impinge/plugin.h>

/* Cylinders and cones about the z axis: the lateral surface and, if asked for, its end discs as
 * pieces of their own. Types have these parameters in this order. */
enum { CAPPED_RADIUS, CAPPED_HEIGHT, CAPPED_CENTER, CAPPED_ENDS };

enum { CAPPED_LATERAL, CAPPED_PARTS_MAX = 3 };

/* The callbacks' `self`: one piece. */
typedef struct capped {
    double radius, height, center[3];
    int part; /* CAPPED_LATERAL, or an end */
} capped;

typedef struct capped_pieces {
    capped part[CAPPED_PARTS_MAX]; /* the instance is its first piece */
    size_t count;
} capped_pieces;

/* `parts`: how many there are with the ends. */
static inline imp_status capped_fill(capped_pieces *pieces, const imp_value *values, size_t parts)
{
    for (int k = 0; k < CAPPED_PARTS_MAX; ++k) {
        capped *s = &pieces->part[k];
        s->part = k;
        s->radius = values[CAPPED_RADIUS].number[0];
        s->height = values[CAPPED_HEIGHT].number[0];
        imp_copy_vector(s->center, &values[CAPPED_CENTER]);
    }
    pieces->count = values[CAPPED_ENDS].number[0] != 0 ? parts : 1;
    return IMP_STATUS_OK;
}

static inline size_t capped_piece_count(const void *self)
{
    return ((const capped_pieces *)self)->count;
}

static inline const void *capped_piece(const void *self, size_t k)
{
    return &((const capped_pieces *)self)->part[k];
}

#endif
