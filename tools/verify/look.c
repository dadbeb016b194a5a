/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/verify/look.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static size_t mixed(uintptr_t what, const double numbers[], size_t count)
{
    uint64_t sum = what;
    for (size_t k = 0; k < count; ++k) {
        uint64_t bits;
        memcpy(&bits, &numbers[k], sizeof bits);
        sum = (sum ^ bits ^ bits >> 29) * UINT64_C(0x9e3779b97f4a7c15);
    }
    return sum >> 32;
}

static uintptr_t place_key(const place *of)
{
    return (uintptr_t)of->chain + 31 * of->maps + (uintptr_t)(of->when->stamp * 1000003);
}

static size_t mixed_box(uintptr_t what, const box3 *b)
{
    const double numbers[6] = {b->lo[0], b->lo[1], b->lo[2], b->hi[0], b->hi[1], b->hi[2]};
    return mixed(what, numbers, 6);
}

static bool is_same(const box3 *a, const box3 *b) { return memcmp(a, b, sizeof *a) == 0; }

const kept *look_jets(memory *all, const place *of, const box3 *where)
{
    const size_t at = mixed_box(place_key(of) + 977 * of->piece, where);
    kept *k = &all->jets[at & (KEPT - 1)];
    if (k->chain == of->chain && k->piece == of->piece && k->maps == of->maps &&
        k->stamp == of->when->stamp && is_same(&k->where, where))
        return k;
    k->stamp = of->when->stamp;
    k->chain = of->chain;
    k->piece = of->piece;
    k->maps = of->maps;
    k->where = *where;
    for (int j = 0; j < VARIABLES; ++j) k->c[j] = middle(where->lo[j], where->hi[j]);
    k->result = enclose(of, where, k->c, k->box, k->centre, &k->divide);
    return k;
}

static const kept_motion *look_motion(memory *all, const place *of, double lo, double hi)
{
    const double times[2] = {lo, hi};
    const size_t at = mixed(place_key(of), times, 2);
    kept_motion *k = &all->motions[at & (KEPT_MOTIONS - 1)];
    if (k->chain == of->chain && k->maps == of->maps && k->stamp == of->when->stamp &&
        k->lo == lo && k->hi == hi)
        return k;
    free(k->motion.ways);
    *k = (kept_motion){
        .chain = of->chain, .maps = of->maps, .stamp = of->when->stamp, .lo = lo, .hi = hi};
    k->result = motion_bound(of, lo, hi, &k->motion, &k->is_affine, &k->divide);
    return k;
}

const form_changes *look_changes(memory *all, const place *of, double lo, double hi,
                                 const double c[3], ld_interval e[3][3], const double w[3])
{
    const double times[2] = {lo, hi};
    kept_changes *k = &all->changes[mixed(place_key(of), times, 2) & (KEPT_CHANGES - 1)];
    if (k->chain == of->chain && k->maps == of->maps && k->stamp == of->when->stamp &&
        k->lo == lo && k->hi == hi && memcmp(k->c, c, sizeof k->c) == 0 &&
        memcmp(k->e, e, sizeof k->e) == 0 && memcmp(k->w, w, sizeof k->w) == 0)
        return &k->found;
    k->chain = of->chain, k->maps = of->maps, k->stamp = of->when->stamp;
    k->lo = lo, k->hi = hi;
    memcpy(k->c, c, sizeof k->c);
    memcpy(k->e, e, sizeof k->e);
    memcpy(k->w, w, sizeof k->w);
    motion_form_changes(of, lo, hi, c, e, w, &k->found);
    return &k->found;
}

const kept_circle *look_circle(memory *all, const place *of, const box3 *where)
{
    const part *shape;
    split unused;
    if (enclose_part(of, where, &shape, &unused) != ENCLOSED || shape->circle == NULL) return NULL;
    const box3 own = place_box(of, 0, where);
    if (enclose_next_part(enclose_piece(of, 0), shape, &own) != NULL) return NULL;
    if (shape->is_moving && !place_follows_main(of, 0)) return NULL;
    const double lo[2] = {where->lo[V], where->lo[T]}, hi[2] = {where->hi[V], where->hi[T]};
    const double numbers[4] = {lo[0], lo[1], hi[0], hi[1]};
    kept_circle *k = &all->circles[mixed((uintptr_t)shape, numbers, 4) & (KEPT_CIRCLES - 1)];
    if (k->part == shape && memcmp(k->lo, lo, sizeof lo) == 0 && memcmp(k->hi, hi, sizeof hi) == 0)
        return k;
    k->part = shape;
    memcpy(k->lo, lo, sizeof lo);
    memcpy(k->hi, hi, sizeof hi);
    for (int j = 0; j < VARIABLES; ++j) k->c[j] = middle(where->lo[j], where->hi[j]);
    circle_take(shape->circle, where, k->c, of->room, k->wide, k->centre);
    return k;
}

static kept_orbit *find_orbit(memory *all, const place *of, double lo, double hi)
{
    const double times[2] = {lo, hi};
    kept_orbit *k = &all->orbits[mixed(place_key(of), times, 2) & (KEPT_ORBITS - 1)];
    if (k->chain == of->chain && k->maps == of->maps && k->stamp == of->when->stamp &&
        k->lo == lo && k->hi == hi)
        return k;
    k->chain = of->chain, k->maps = of->maps, k->stamp = of->when->stamp;
    k->lo = lo, k->hi = hi;
    orbit_take(of, lo, hi, &k->orbit);
    k->has_rows = false;
    return k;
}

const orbit *look_orbit(memory *all, const place *of, double lo, double hi)
{
    return &find_orbit(all, of, lo, hi)->orbit;
}

const orbit_rows *look_rows(memory *all, const place *of, double lo, double hi, const double n[3])
{
    kept_orbit *k = find_orbit(all, of, lo, hi);
    if (!k->has_rows || memcmp(k->rows.v, n, sizeof k->rows.v) != 0)
        orbit_take_rows(&k->orbit, n, &k->rows);
    k->has_rows = true;
    return &k->rows;
}

static void take_jets(const place *of, const box3 *where, kept_net *k)
{
    jet wide[3], centre[3];
    double at[3];
    for (int j = 0; j < VARIABLES; ++j) at[j] = middle(where->lo[j], where->hi[j]);
    k->result = enclose(of, where, at, wide, centre, &k->divide);
    if (k->result == ENCLOSED && !net_of_jets(wide, centre, where->lo, where->hi, &k->net))
        k->net.n[0] = 0;
}

enclosed look_net(memory *all, const place *of, const box3 *where, form *found, split *divide)
{
    const part *shape;
    place bare = *of;
    const enclosed result = enclose_part(of, where, &shape, divide);
    if (result != ENCLOSED) return result;
    *found = (form){NULL, NULL};
    if (of->maps > 0) {
        const kept_motion *m = look_motion(all, of, where->lo[T], where->hi[T]);
        *divide = m->divide;
        if (m->result != ENCLOSED) return m->result;
        if (m->is_affine) found->motion = &m->motion, bare.maps = 0;
    }
    const box3 own = place_box(of, 0, where);
    const bool alone = enclose_next_part(enclose_piece(of, 0), shape, &own) == NULL;
    const bool follows = place_follows_main(of, 0) || !shape->is_moving;
    const bool exact = shape->net != NULL && alone && bare.maps == 0 && follows;
    const uint64_t stamp = exact ? 0 : of->when->stamp;
    box3 key = *where; /* no box has the time INFINITY */
    if (!shape->is_moving && alone && bare.maps == 0) key.lo[T] = key.hi[T] = INFINITY;
    const chain *moved = bare.maps > 0 ? of->chain : NULL;
    const size_t at = mixed_box(
        (uintptr_t)shape + (uintptr_t)moved + 31 * bare.maps + (uintptr_t)(stamp * 1000003), &key);
    kept_net *k = &all->nets[at & (KEPT_NETS - 1)];
    if (k->part != shape || k->chain != moved || k->maps != bare.maps || k->stamp != stamp ||
        !is_same(&k->where, &key)) {
        k->part = shape, k->chain = moved, k->maps = bare.maps, k->stamp = stamp, k->where = key;
        k->result = ENCLOSED;
        if (!exact || !net_restrict(shape->net, where->lo, where->hi, &k->net))
            take_jets(&bare, where, k);
    }
    *divide = k->divide;
    if (k->result == ENCLOSED && k->net.n[0] > 0) found->net = &k->net;
    return k->result;
}

void look_free(memory *all)
{
    for (size_t k = 0; k < KEPT_MOTIONS && all != NULL; ++k) free(all->motions[k].motion.ways);
    free(all);
}
