/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_ASIDE_SEARCH_H
#define CORE_SURFACE_ASIDE_SEARCH_H

#include "core/surface/aside.h"
#include "core/surface/surface_internal.h"

/* What aside.c, which chooses maps to set aside, asks of each surface: aside_look.c. */

enum { ASIDE_MOVING_MOST = 6, ASIDE_MAPS_MOST = 8 };

/* The surface under some of its maps, in their order. */
typedef struct aside_part {
    surface of;
    mapping maps[ASIDE_MAPS_MOST];
} aside_part;

/* Takes the maps of which the bit is set. Precondition: there are at most ASIDE_MAPS_MOST. */
void aside_part_of(const surface *s, uint32_t which, aside_part *p);

/* The maps of both surfaces: how far those that are exchanged move images, and which move. */
typedef struct aside_search {
    const surface *const *s;
    const imp_region *times;
    double enough;
    double exchange[2][ASIDE_MAPS_MOST][ASIDE_MAPS_MOST]; /* of maps i < j; length */
    struct {
        int side;
        size_t map;
    } moving[2 * ASIDE_MAPS_MOST];
    size_t count; /* of those that move */
    size_t *spans;
    aside_look *const *looks;
    int *asked;
} aside_search;

/* Finds which maps of one surface move, and what exchanging them does. */
imp_status aside_look_at_maps(aside_search *q, int side);

/* The moments at which parts are compared before anything is bounded: number k of the times. */
enum { ASIDE_MOMENTS = 3 };
double aside_moment(const imp_region *times, int k);

/* Whether parts surely differ, since their images of the origin do at the first moment. */
bool aside_images_differ(const aside_search *q, const uint32_t which[2]);

#endif
