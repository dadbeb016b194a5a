/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "tools/verify/shadow_internal.h"

/* No more is shared out than what its values vary by; where derivatives have no bounds, it is
 * shared by those of the parts. */
void shadow_find_sizes(const jet *over, const jet *at, const jet parts[], int count,
                       const double half[VARIABLES], double size[VARIABLES])
{
    const double most = over->v.hi - over->v.lo;
    double sum = 0, ways[VARIABLES], way = PROOF_TINY;
    for (int j = 0; j < VARIABLES; ++j) {
        size[j] = fabs(ld_interval_mid(at->d[j])) * half[j];
        for (int k = 0; k < VARIABLES; ++k) {
            const ld_interval bend = j <= k ? over->h[j][k] : over->h[k][j];
            if (half[j] > 0 && half[k] > 0)
                size[j] += 0.5 * ld_interval_mag(bend) * half[j] * half[k];
        }
        ways[j] = 0;
        for (int i = 0; i < count; ++i) ways[j] += ld_interval_mag(parts[i].d[j]) * half[j];
        sum += size[j];
        way += ways[j];
    }
    for (int j = 0; j < VARIABLES && !(sum <= most); ++j)
        size[j] = most * (sum < INFINITY ? size[j] / sum : ways[j] / way);
}

/* The parts of what a side reaches, over a box and at its centre. False: they are not known. */
static bool take_parts(memory *known, const area *s, const aim *a, orbit_parts *wide,
                       orbit_parts *narrow, double c[VARIABLES])
{
    const orbit *o = look_orbit(known, &s->of, s->where.lo[T], s->where.hi[T]);
    if (!o->is_known) return false;
    const orbit_rows *rows = look_rows(known, &s->of, s->where.lo[T], s->where.hi[T], a->n);
    const int turns = o->turns ? 3 : 1;
    const kept_circle *of = a->circles ? look_circle(known, &s->of, &s->where) : NULL;
    if (of != NULL) {
        orbit_take_parts(rows->wide, turns, of->wide, CIRCLE_PARTS, wide);
        orbit_take_parts(rows->centre, turns, of->centre, CIRCLE_PARTS, narrow);
        memcpy(c, of->c, sizeof of->c);
        return true;
    }
    place bare = s->of;
    bare.maps = 0;
    const kept *k = look_jets(known, &bare, &s->where);
    if (k->result != ENCLOSED) return false;
    orbit_take_parts(rows->wide, turns, &k->box, 1, wide);
    orbit_take_parts(rows->centre, turns, &k->centre, 1, narrow);
    memcpy(c, k->c, sizeof k->c);
    return true;
}

bool shadow_at_all_angles(memory *known, const area *s, const aim *a, ld_interval *to,
                          double *at_centre, double *size)
{
    orbit_parts wide, narrow;
    ld_interval offset[BOX_DIMS];
    double half[VARIABLES], c[VARIABLES];
    if (!take_parts(known, s, a, &wide, &narrow, c)) return false;
    const jet over = orbit_reach(&wide), at = orbit_reach(&narrow);
    for (int j = 0; j < VARIABLES; ++j) {
        const ld_interval all = ld_interval_make(s->where.lo[j], s->where.hi[j]);
        offset[j] = ld_interval_sub(all, ld_interval_of(c[j]));
        half[j] = 0.5 * (all.hi - all.lo);
    }
    *at_centre = ld_interval_mid(at.v);
    *to = jet_values(&over, &at, offset);
    if (size != NULL) shadow_find_sizes(&over, &at, &over, 1, half, size);
    return true;
}
