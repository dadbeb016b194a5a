/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stdlib.h>

#include "core/base/status.h"
#include "core/solid/solid_internal.h"
#include "core/surface/region.h"

/* Lemma. If no point of one shell is on another, the first is wholly on one side of the second,
 * that of any of its points; and a shell with a point outside of another is not wholly inside of
 * it. Where neither can be shown, a point in both is not classified: whether the one is a cavity of
 * the other is not known. */

/* --- Do shells intersect? --------------------------------------------------------------------- */

/* Regions that are examined for two patches, and pairs of patches of two shells, before it counts
 * as unknown whether they intersect. */
enum { REGIONS_MAX = 1 << 15 };
#define PATCH_PAIRS_MAX 1e9

typedef struct piece_of {
    const patch *p;
    imp_region region;
    imp_model model[3];
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

/* Chooses the parameter, u or v, of which the region is the wider part of the domain, if it can be
 * split there; else the other. False: neither can be split. */
static bool parameter_of(const piece_of *x, parameter *j)
{
    const double u = x->region.d[0] / (x->p->hi[0] - x->p->lo[0]);
    const double v = x->region.d[1] / (x->p->hi[1] - x->p->lo[1]);
    *j = v > u ? PARAMETER_V : PARAMETER_U;
    if (!region_can_split(&x->region, *j)) *j = *j == PARAMETER_U ? PARAMETER_V : PARAMETER_U;
    return region_can_split(&x->region, *j);
}

static imp_code bound_piece(const parting *w, piece_of *x)
{
    const imp_code code = patch_include(x->p, &x->region, x->model, w->error);
    if (code == IMP_SUCCESS) solid_box_around(x->model, &x->box);
    return code;
}

/* Returns whether the heights of all points of one piece, along the normal of either, differ from
 * those of the other. Boxes alone would have to be as small as the wall between two surfaces that
 * run along each other is thin. A NaN parts nothing. */
static bool planes_part(const piece_of *a, const piece_of *b)
{
    for (int side = 0; side < 2; ++side) {
        const imp_model *m = side == 0 ? a->model : b->model;
        imp_model n[3];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            n[i] = imp_num(m[j].b[0] * m[k].b[1] - m[k].b[0] * m[j].b[1]);
        }
        const imp_model height[2] = {imp_dot3(n, a->model), imp_dot3(n, b->model)};
        const imp_interval x = imp_model_range(&height[0]), y = imp_model_range(&height[1]);
        if (x.hi < y.lo || y.hi < x.lo) return true;
    }
    return false;
}

/* Sets *apart to false unless all points of the one are shown to differ from all of the other. */
static imp_code part_pieces(parting *w, const piece_of *a, const piece_of *b, bool *apart)
{
    if (!*apart || solid_boxes_apart(&a->box, &b->box) || planes_part(a, b)) return IMP_SUCCESS;
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
        imp_code code = bound_piece(w, &half);
        if (code == IMP_SUCCESS) code = part_pieces(w, &half, other, apart);
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

static imp_code whole_of(const parting *w, size_t index, piece_of *x)
{
    const patches *all = &w->s->patches;
    const patch *p = &all->patch[index];
    *x = (piece_of){.p = p,
                    .region = region_make((double[3]){p->lo[0], p->lo[1], all->t},
                                          (double[3]){p->hi[0], p->hi[1], all->t})};
    return bound_piece(w, x);
}

static imp_code part_shells(const solid *s, size_t x, size_t y, bool *apart, bool *stopped,
                            imp_error *error)
{
    const size_t n = s->patches.count;
    *apart = (double)n * (double)n <= PATCH_PAIRS_MAX;
    for (size_t i = 0; i < n && *apart; ++i) {
        if (s->shells.facing[i].shell != x) continue;
        *stopped = !limit_watch_goes_on(s->watch);
        if (*stopped) return IMP_SUCCESS;
        parting w = {s, 0, error};
        piece_of a, b;
        imp_code code = whole_of(&w, i, &a);
        for (size_t k = 0; k < n && *apart && code == IMP_SUCCESS; ++k) {
            if (s->shells.facing[k].shell != y || solid_boxes_apart(&a.box, &s->boxes[k])) continue;
            w.work = 0;
            code = whole_of(&w, k, &b);
            if (code == IMP_SUCCESS) code = part_pieces(&w, &a, &b, apart);
        }
        if (code != IMP_SUCCESS) return code;
    }
    return IMP_SUCCESS;
}

/* --- Which shell is inside which? ------------------------------------------------------------- */

/* The answer whether a shell is wholly inside of another. */
typedef enum nesting { NESTING_UNKNOWN, NESTING_INSIDE, NESTING_NOT } nesting;

/* Points of each patch, in rows, and of a whole shell, that are tested against another shell. */
enum { ROWS = 5, POINTS_MAX = 1000 };

/* What is known of where shell x lies in shell y. */
typedef struct comparison {
    const solid *s;
    size_t x, y; /* shells */
    bool tried;  /* to part the two */
    int points;  /* that were examined */
    nesting found;
} comparison;

/* Tries to decide by point k of a patch of x: it shows that x is not inside of y if it is outside,
 * and that x is inside if it is inside and the two shells do not intersect. */
static imp_code compare_point(comparison *c, const patch *p, int k, bool *stopped, imp_error *error)
{
    const double uv[1][2] = {{patch_between(p->lo[0], p->hi[0], k / ROWS, ROWS - 1),
                              patch_between(p->lo[1], p->hi[1], k % ROWS, ROWS - 1)}};
    vec3 at;
    double off[1];
    winding_number wound;
    bool apart;
    c->points += 1;
    imp_code code = patch_eval(p, c->s->patches.t, 1, uv, &at, off, error);
    if (code == IMP_SUCCESS) code = solid_wind(c->s, c->y, at, off[0], &wound, error);
    if (code != IMP_SUCCESS || wound.is_near || !wound.is_whole) return code;
    if (wound.times == 0) return c->found = NESTING_NOT, code;
    if (c->tried) return code;
    c->tried = true;
    code = part_shells(c->s, c->x, c->y, &apart, stopped, error);
    if (code == IMP_SUCCESS && !*stopped && apart) c->found = NESTING_INSIDE;
    return code;
}

/* Finds out whether shell x is wholly inside shell y. */
static imp_code is_inside(const solid *s, size_t x, size_t y, nesting *found, bool *stopped,
                          imp_error *error)
{
    comparison c = {.s = s, .x = x, .y = y};
    imp_code code = IMP_SUCCESS;
    for (size_t i = 0; i < s->patches.count; ++i) {
        if (s->shells.facing[i].shell != x) continue;
        for (int k = 0; k < ROWS * ROWS; ++k) {
            *stopped = *stopped || !limit_watch_goes_on(s->watch);
            if (code != IMP_SUCCESS || *stopped || c.found != NESTING_UNKNOWN ||
                c.points >= POINTS_MAX)
                break;
            code = compare_point(&c, &s->patches.patch[i], k, stopped, error);
        }
    }
    *found = c.found;
    return code;
}

/* Sets depth[x] to the length of the longest chain of shells around x. A chain contains
 * each shell once, so that `count` rounds are enough. */
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

imp_code solid_depths(const solid *s, const size_t *shell, size_t count, size_t *depth, bool *known,
                      bool *stopped, imp_error *error)
{
    bool *inside = calloc(count * count, sizeof *inside);
    if (inside == NULL) return error_set_memory(error);
    imp_code code = IMP_SUCCESS;
    *known = true;
    for (size_t k = 0; k < count * count && code == IMP_SUCCESS && !*stopped && *known; ++k) {
        nesting found = NESTING_NOT;
        const size_t x = k / count, y = k % count;
        if (x != y) code = is_inside(s, shell[x], shell[y], &found, stopped, error);
        inside[k] = found == NESTING_INSIDE;
        *known = found != NESTING_UNKNOWN;
    }
    measure_chains(inside, count, depth);
    free(inside);
    return code;
}
