/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/shadow_internal.h"

#include <math.h>

#include "core/common/array.h"
#include "tools/verify/round.h"

/* --- Distances from a centre ------------------------------------------------------------------ */

/* Bounds the distance from a centre. *size: NULL, or how much it depends on each variable. */
static ld_interval distances(const kept *k, const aim *a, double *at_centre, double *size,
                             double *blur)
{
    jet wide[CENTRE_PARTS], narrow[CENTRE_PARTS];
    centre_parts(k->box, a->about, wide);
    centre_parts(k->centre, a->about, narrow);
    const jet over = centre_distance(wide, a), at = centre_distance(narrow, a);
    ld_interval offset[BOX_DIMS];
    double half[VARIABLES];
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(k->where.lo[j], k->where.hi[j]);
        offset[j] = ld_interval_sub(all, ld_interval_of(k->c[j]));
        half[j] = 0.5 * (all.hi - all.lo);
    }
    *at_centre = ld_interval_mid(at.v);
    *blur = 0.5 * (at.v.hi - at.v.lo);
    if (size != NULL) shadow_find_sizes(&over, &at, wide, 3, half, size);
    return jet_values(&over, &at, offset);
}

/* --- Control points --------------------------------------------------------------------------- */

/* Half of what the points differ by along u and v, and by how much time bends their ways. */
static void net_sizes(const reach *r, double size[VARIABLES])
{
    const int count[2] = {r->n[0], r->n[1]}, step[2] = {r->n[1] * r->n[2], r->n[2]};
    const int all = r->n[0] * r->n[1] * r->n[2];
    for (int j = 0; j < 2; ++j) {
        size[j] = r->share[j];
        for (int i = 0; i < all; ++i) {
            if (i / step[j] % count[j] != 0) continue;
            double lo = r->g[i], hi = lo;
            for (int k = 1; k < count[j]; ++k) {
                lo = proof_smaller(lo, r->g[i + k * step[j]]);
                hi = proof_larger(hi, r->g[i + k * step[j]]);
            }
            size[j] = proof_larger(size[j], r->share[j] + 0.5 * (hi - lo));
        }
    }
    double bend = 0;
    for (int i = 0; i < all; ++i)
        if (i % r->n[2] > 0 && i % r->n[2] < r->n[2] - 1)
            bend = proof_larger(bend, fabs(r->g[i - 1] - 2 * r->g[i] + r->g[i + 1]));
    size[T] = r->share[T] + bend;
}

/* --- Areas ------------------------------------------------------------------------------------ */

void areas_begin(areas *all, memory *known)
{
    all->memory = known;
    all->count = 0;
    all->cut.along = -1;
}

/* Shares out what the values of clocks blur: by what is known of each clock, or else by the part of
 * its whole range, among those that stages follow. */
static void share_blur(const place *of, double blur, double clocks[CLOCKS_MAX])
{
    const values *when = of->when;
    double width[CLOCKS_MAX] = {0}, known = 0, sum = 0;
    for (size_t k = 0; k <= of->maps; ++k) {
        const size_t clock = of->of->stages[of->chain->stages[k]].clock;
        const scene_clock *whole = &of->of->clocks[clock];
        if (clock != when->main && when->hi[clock] > when->lo[clock])
            width[clock] = (when->hi[clock] - when->lo[clock]) / (whole->hi - whole->lo);
    }
    for (size_t k = 0; k < when->count; ++k) sum += width[k], known += clocks[k];
    for (size_t k = 0; k < when->count && blur > 0 && sum > 0; ++k)
        clocks[k] += width[k] == 0 || isinf(blur) ? (width[k] > 0 ? blur : 0)
                     : known > 0                  ? blur * (clocks[k] / known)
                                                  : blur * (width[k] / sum);
}

void areas_sizes(const areas *all, size_t index, const aim *a, double size[VARIABLES],
                 double clocks[CLOCKS_MAX])
{
    const area *s = &all->at[index];
    form x;
    split unused;
    reach r;
    double ends, blur = INFINITY, way[CLOCKS_MAX];
    for (size_t k = 0; k < s->of.when->count; ++k) clocks[k] = 0;
    for (int j = 0; j < VARIABLES; ++j) size[j] = INFINITY; /* of what has no bounds */
    if (a->is_round) {
        ld_interval unused_reach;
        blur = 0;
        shadow_at_all_angles(all->memory, s, a, &unused_reach, &ends, size);
    } else if (a->about != NULL) {
        distances(look_jets(all->memory, &s->of, &s->where), a, &ends, size, &blur);
    } else if (look_net(all->memory, &s->of, &s->where, &x, &unused) == ENCLOSED && x.net != NULL) {
        net_along(&x, a->n, &r, way);
        net_sizes(&r, size);
        for (size_t k = 0; x.motion != NULL && k < x.motion->way_count; ++k)
            clocks[x.motion->ways[k].clock] = way[k];
        blur = r.blur;
    }
    if (s->of.when->count > 1) share_blur(&s->of, blur, clocks);
}

const char *shadow_why_unknown(enclosed result)
{
    if (result == ENCLOSED_UNSAID) return "a formula leaves open what is there at these times";
    return result == ENCLOSED_UNDEFINED ? "a formula has no value at a point of it" : NULL;
}

static const char *add_halves(areas *all, const place *of, const box3 *where, const aim *a,
                              const split *by)
{
    box3 half[2] = {*where, *where};
    half[0].hi[by->along] = half[1].lo[by->along] = by->at;
    const char *why = areas_add(all, of, &half[0], a);
    return why != NULL ? why : areas_add(all, of, &half[1], a);
}

/* Returns a lower bound of the distance from the line, times |d|. */
static double least_distance(const kept *k, const aim *a)
{
    const aim out = {.n = {1, 0, 0}, .about = a->about};
    double unused[2];
    return distances(k, &out, &unused[0], NULL, &unused[1]).lo;
}

/* What distances at one time, with the sign of the aim, are at all times. */
static ld_interval slipped(ld_interval x, const aim *a)
{
    const ld_interval size = ld_interval_abs(x);
    if (a->slip == 0) return x;
    const ld_interval square =
        ld_interval_add(ld_interval_sqr(size), ld_interval_plus_minus(a->slip));
    const ld_interval root =
        ld_interval_sqrt(ld_interval_make(proof_larger(square.lo, 0), square.hi));
    return a->n[0] > 0 ? root : ld_interval_neg(root);
}

/* Bounds what an aim about a centre bounds of an area; s->ends[0] becomes that of its middle. */
static ld_interval cast_about(memory *known, area *s, const kept *k, const aim *a)
{
    double unused;
    const ld_interval x = distances(k, a, &s->ends[0], NULL, &unused);
    if (a->n[1] == 0) return slipped(x, a);
    if (a->slip == 0 && a->lift == 0) return x;
    const double least = least_distance(k, a);
    const double change = centre_change_upper(known, &s->of, &s->where, a, least);
    return ld_interval_add(x, ld_interval_plus_minus(change));
}

/* Bounds how far an area reaches at any angle; where that is not known, its bounds stay infinite.
 * */
static enclosed cast_turning(memory *known, area *s, const aim *a, split *by)
{
    place bare = s->of;
    bare.maps = 0;
    ld_interval x;
    double middle_reach;
    const kept *k = look_jets(known, &bare, &s->where);
    const enclosed result = k->result;
    *by = k->divide;
    if (result != ENCLOSED || !shadow_at_all_angles(known, s, a, &x, &middle_reach, NULL))
        return result;
    s->ends[0] = s->ends[1] = middle_reach, s->least = x.lo;
    for (int i = 0; i < NET_TIMES; ++i) s->upper[i] = x.hi;
    return result;
}

/* Bounds an area, whose bounds are infinite. */
static enclosed cast(areas *all, area *s, const aim *a, split *by)
{
    form x = {NULL, NULL};
    enclosed result;
    if (a->about != NULL) {
        const kept *k = look_jets(all->memory, &s->of, &s->where);
        result = k->result, *by = k->divide;
        if (result != ENCLOSED) return result;
        const ld_interval all_of_it = cast_about(all->memory, s, k, a);
        s->ends[1] = s->ends[0], s->least = all_of_it.lo;
        for (int i = 0; i < NET_TIMES; ++i) s->upper[i] = all_of_it.hi;
        return result;
    }
    if (a->is_round) return cast_turning(all->memory, s, a, by);
    result = look_net(all->memory, &s->of, &s->where, &x, by);
    if (result == ENCLOSED && x.net != NULL) {
        reach r;
        net_along(&x, a->n, &r, NULL);
        for (int k = 0; k < NET_TIMES; ++k) s->upper[k] = r.upper[k];
        s->ends[0] = r.ends[0], s->ends[1] = r.ends[1], s->least = r.least;
    }
    return result;
}

const char *areas_add(areas *all, const place *of, const box3 *where, const aim *a)
{
    area made = {.of = *of, .where = *where, .ends = {-INFINITY, -INFINITY}, .least = -INFINITY};
    for (int k = 0; k < NET_TIMES; ++k) made.upper[k] = INFINITY;
    split by = {0, 0};
    const enclosed result = cast(all, &made, a, &by);
    if (result == ENCLOSED_EMPTY) return NULL;
    if (result == ENCLOSED_SPLIT && by.along >= (aim_is_of_jets(a) ? VARIABLES : T)) {
        all->cut = by;
        return NULL;
    }
    if (result == ENCLOSED_SPLIT) return add_halves(all, of, where, a, &by);
    if (result != ENCLOSED) return shadow_why_unknown(result);
    area *grown = array_reserve(all->at, all->count, &all->room, sizeof *grown);
    if (grown == NULL) return "memory ran out";
    all->at = grown;
    all->cast += 1;
    grown[all->count++] = made;
    return NULL;
}

const char *areas_divide(areas *all, size_t index, const aim *a, bool *divided)
{
    const area was = all->at[index];
    split by = {-1, 0};
    double most = 0, widest = 0, size[VARIABLES], clocks[CLOCKS_MAX], blur = 0;
    areas_sizes(all, index, a, size, clocks);
    for (size_t k = 0; k < was.of.when->count; ++k) blur = proof_larger(blur, clocks[k]);
    for (int j = 0; j < (aim_is_of_jets(a) ? VARIABLES : T); ++j) {
        const double lo = was.where.lo[j], hi = was.where.hi[j], mid = middle(lo, hi);
        if (!(lo < mid && mid < hi)) continue;
        const double width = hi - lo;
        if (by.along >= 0 && !(size[j] > most) && !(size[j] == most && width > widest)) continue;
        by = (split){j, mid};
        most = size[j], widest = width;
    }
    *divided = by.along >= 0 && (aim_is_of_jets(a) || !(size[T] > 2 * most)) && !(blur > 2 * most);
    if (!*divided) return NULL;
    all->at[index] = all->at[--all->count];
    return add_halves(all, &was.of, &was.where, a, &by);
}

limits areas_limits(const areas *all)
{
    limits r = {.ends = {-INFINITY, -INFINITY}, .least = INFINITY};
    for (int k = 0; k < NET_TIMES; ++k) r.upper[k] = -INFINITY;
    for (size_t i = 0; i < all->count; ++i) {
        const area *s = &all->at[i];
        for (int k = 0; k < NET_TIMES; ++k)
            if (!(s->upper[k] <= r.upper[k])) r.upper[k] = s->upper[k], r.worst[k] = i;
        r.least = proof_smaller(s->least, r.least);
        for (int end = 0; end < 2; ++end) r.ends[end] = proof_larger(s->ends[end], r.ends[end]);
    }
    return r;
}
