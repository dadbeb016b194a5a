/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>

#include "core/base/status.h"
#include "core/solid/solid_internal.h"
#include "core/surface/region.h"

/* Lemma. If no point of one shell is on another, the first is wholly on one side of the second,
 * that of any of its points; where that cannot be shown, they count as intersecting, which fills
 * cavities and never makes one. */

/* --- Do shells intersect? --------------------------------------------------------------------- */

/* Regions looked at for two patches, and pairs of patches of two shells, before they count as
 * intersecting. */
enum { REGIONS_MAX = 1 << 12 };
#define PATCH_PAIRS_MAX 1e9

typedef struct piece_of {
    const patch *p;
    imp_region region;
    solid_box box;
} piece_of;

typedef struct parting {
    const solid *s;
    int work;
    imp_error *error;
} parting;

static double size_of(const solid_box *box)
{
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        const double width = box->hi[i] - box->lo[i];
        if (!(width <= most)) most = width;
    }
    return most;
}

/* Halves of a region along the relatively wider parameter. */
static bool parameter_of(const piece_of *x, parameter *j)
{
    const double u = x->region.d[0] / (x->p->hi[0] - x->p->lo[0]);
    const double v = x->region.d[1] / (x->p->hi[1] - x->p->lo[1]);
    *j = v > u ? PARAMETER_V : PARAMETER_U;
    if (!region_can_split(&x->region, *j)) *j = *j == PARAMETER_U ? PARAMETER_V : PARAMETER_U;
    return region_can_split(&x->region, *j);
}

/* *apart stays true where all points of both are shown to differ. */
static imp_code part_pieces(parting *w, const piece_of *a, const piece_of *b, bool *apart)
{
    if (!*apart || solid_boxes_apart(&a->box, &b->box)) return IMP_SUCCESS;
    const piece_of *larger = size_of(&a->box) >= size_of(&b->box) ? a : b;
    const piece_of *other = larger == a ? b : a;
    parameter j;
    if (++w->work > REGIONS_MAX || !parameter_of(larger, &j)) {
        *apart = false;
        return IMP_SUCCESS;
    }
    for (int side = 0; side < 2; ++side) {
        piece_of half = *larger;
        region_set_half(&half.region, &larger->region, j, side);
        imp_code code = solid_box_of(w->s, half.p, &half.region, &half.box, w->error);
        if (code == IMP_SUCCESS) code = part_pieces(w, &half, other, apart);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

static piece_of whole_of(const solid *s, size_t index)
{
    const patch *p = &s->patches.patch[index];
    return (piece_of){p,
                      region_make((double[3]){p->lo[0], p->lo[1], s->patches.t},
                                  (double[3]){p->hi[0], p->hi[1], s->patches.t}),
                      s->boxes[index]};
}

static imp_code part_shells(const solid *s, size_t x, size_t y, bool *apart, bool *stopped,
                            imp_error *error)
{
    const size_t n = s->patches.count;
    *apart = (double)n * (double)n <= PATCH_PAIRS_MAX;
    for (size_t i = 0; i < n && *apart; ++i) {
        if (s->shells.facing[i].shell != x) continue;
        *stopped = !patch_watch_goes_on(s->watch);
        if (*stopped) return IMP_SUCCESS;
        const piece_of a = whole_of(s, i);
        for (size_t k = 0; k < n && *apart; ++k) {
            if (s->shells.facing[k].shell != y || solid_boxes_apart(&a.box, &s->boxes[k])) continue;
            const piece_of b = whole_of(s, k);
            parting w = {s, 0, error};
            const imp_code code = part_pieces(&w, &a, &b, apart);
            if (code != IMP_SUCCESS) return code;
        }
    }
    return IMP_SUCCESS;
}

/* --- Which shell is inside which? ------------------------------------------------------------- */

static imp_code point_of(const solid *s, size_t shell, vec3 *x, double *off, imp_error *error)
{
    size_t k = 0;
    while (s->shells.facing[k].shell != shell) ++k;
    const patch *p = &s->patches.patch[k];
    double uv[1][2];
    patch_corner(p, 0, uv[0]);
    return patch_eval(p, s->patches.t, 1, (const double(*)[2])uv, x, off, error);
}

/* *inside: shell x is wholly inside shell y. */
static imp_code is_inside(const solid *s, size_t x, size_t y, bool *inside, bool *stopped,
                          imp_error *error)
{
    vec3 at;
    double off[1];
    winding_number found;
    *inside = false;
    imp_code code = point_of(s, x, &at, off, error);
    if (code == IMP_SUCCESS) code = solid_wind(s, y, at, off[0], &found, error);
    if (code != IMP_SUCCESS || found.is_near || found.times == 0) return code;
    return part_shells(s, x, y, inside, stopped, error);
}

/* Lengthens chains until none grows: no shell is inside itself. */
static void measure_chains(const bool *inside, size_t count, size_t *depth)
{
    bool grows = true;
    for (size_t k = 0; k < count; ++k) depth[k] = 0;
    for (size_t round = 0; grows && round < count; ++round) {
        grows = false;
        for (size_t x = 0; x < count; ++x)
            for (size_t y = 0; y < count; ++y)
                if (inside[x * count + y] && depth[x] <= depth[y])
                    depth[x] = depth[y] + 1, grows = true;
    }
}

imp_code solid_depths(const solid *s, const size_t *shell, size_t count, size_t *depth,
                      bool *stopped, imp_error *error)
{
    bool *inside = calloc(count * count, sizeof *inside);
    if (inside == NULL) return error_set_memory(error);
    imp_code code = IMP_SUCCESS;
    for (size_t x = 0; x < count && code == IMP_SUCCESS && !*stopped; ++x)
        for (size_t y = 0; y < count && code == IMP_SUCCESS && !*stopped; ++y)
            if (x != y)
                code = is_inside(s, shell[x], shell[y], &inside[x * count + y], stopped, error);
    measure_chains(inside, count, depth);
    free(inside);
    return code;
}
