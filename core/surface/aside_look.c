/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/aside_search.h"

#include <math.h>

#include "core/surface/commute.h"

/* What is known of the maps of one surface, and kept for its other pairs. */

void aside_part_of(const surface *s, uint32_t which, aside_part *p)
{
    size_t count = 0;
    p->of = *s;
    for (size_t k = 0; k < s->map_count; ++k)
        if ((which >> k & 1u) != 0) p->maps[count++] = s->maps[k];
    p->of.maps = p->maps;
    p->of.map_count = count;
}

static void add_moving(aside_search *q, int side, size_t map)
{
    q->moving[q->count].side = side;
    q->moving[q->count++].map = map;
}

/* Takes what is kept of the surface. False: it was not looked at over these times. */
static bool take_look(aside_search *q, int side)
{
    const aside_look *look = q->looks[side];
    const size_t count = q->s[side]->map_count;
    if (count > ASIDE_KEPT || look->from != q->times->lo[2] || look->to != q->times->hi[2])
        return false;
    for (size_t k = 0; k < count; ++k)
        if (look->moves[k]) add_moving(q, side, k);
    q->exchange[side][0][1] = look->exchange;
    return true;
}

static void keep_look(const aside_search *q, int side, const map_law *law)
{
    const size_t count = q->s[side]->map_count;
    if (count > ASIDE_KEPT) return;
    *q->looks[side] = (aside_look){.from = q->times->lo[2], .to = q->times->hi[2]};
    for (size_t k = 0; k < count; ++k) q->looks[side]->moves[k] = law[k].moves;
    q->looks[side]->exchange = q->exchange[side][0][1];
}

imp_status aside_look_at_maps(aside_search *q, int side)
{
    map_law law[ASIDE_MAPS_MOST];
    const surface *s = q->s[side];
    *q->asked = side;
    if (take_look(q, side)) return IMP_STATUS_OK;
    for (size_t k = 0; k < s->map_count; ++k) {
        imp_pose pose;
        const imp_status status = surface_pose_of_maps(s, k, k + 1, q->times, &pose);
        if (status != IMP_STATUS_OK) return status;
        law[k] = map_law_of(&pose);
        if (law[k].moves) add_moving(q, side, k);
        for (size_t i = 0; i < k; ++i)
            q->exchange[side][i][k] = map_laws_exchange_upper(&law[i], &law[k]);
    }
    keep_look(q, side, law);
    return IMP_STATUS_OK;
}

double aside_moment(const imp_region *times, int k)
{
    static const double at[ASIDE_MOMENTS] = {0.618, 0.237, 1};
    return times->lo[2] + at[k] * (times->hi[2] - times->lo[2]);
}

/* Returns where these maps move the origin at the first moment. NULL: that is not known. */
static const double *image_of(const aside_search *q, int side, uint32_t which)
{
    if (q->s[side]->map_count > ASIDE_KEPT) return NULL;
    aside_image *image = &q->looks[side]->image[which];
    if (!image->is_asked) {
        aside_part p;
        aside_part_of(q->s[side], which, &p);
        image->is_known =
            surface_move_outward(&p.of, 0, aside_moment(q->times, 0), 1, image->x) == IMP_STATUS_OK;
        image->is_asked = true;
    }
    return image->is_known ? image->x : NULL;
}

bool aside_images_differ(const aside_search *q, const uint32_t which[2])
{
    const double *a = image_of(q, 0, which[0]), *b = image_of(q, 1, which[1]);
    bool differ = false;
    for (int i = 0; i < 3 && a != NULL && b != NULL; ++i)
        differ = differ || fabs(a[i] - b[i]) > q->enough;
    return differ;
}
