/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/held_values.h"

#include <impinge/model.h>
#include <math.h>

#include "core/base/rounding.h"
#include "core/surface/clocked.h"
#include "core/surface/slip.h"

/* Where a map stands while later ones are looked at: a time, or a value of its parameter. */
static double stand_of(const shared_instance *p, const value_box *box)
{
    return p->inner != NULL ? box->at[p->clock] : box->t_start;
}

/* Adds a map as it is where it stands. False: no memory. */
static bool add_standing(surface *to, shared_instance *p, const value_box *box)
{
    shared_instance *at = clocked_new(clocked_own(p), p->clock, stand_of(p, box));
    if (at == NULL) return false;
    const bool is_added = surface_add_instance(to, at) == IMP_SUCCESS;
    instance_release(at);
    return is_added;
}

/* Makes s under its first `maps` maps, which stand, and under one more, which follows time in the
 * place of what it follows. NULL: no memory. */
static surface *under_one_more(const surface *s, size_t maps, const value_box *box)
{
    surface *made = surface_new_of(surface_stage(s, 0));
    bool ok = made != NULL;
    for (size_t k = 0; k < maps && ok; ++k) ok = add_standing(made, s->maps[k].origin, box);
    if (ok) ok = surface_add_instance(made, clocked_own(s->maps[maps].origin)) == IMP_SUCCESS;
    if (ok && surface_divide(made) == IMP_SUCCESS) return made;
    surface_free(made);
    return NULL;
}

/* Bounds the slip of map k by itself; INFINITY: it does not only turn s within itself. */
static imp_status slip_of_map(const surface *s, size_t k, const imp_model bare[3],
                              const value_box *box, double *slip)
{
    const shared_instance *p = s->maps[k].origin, *own = clocked_own(s->maps[k].origin);
    const stage_range of = stage_range_of(p, box);
    const double stand = stand_of(p, box);
    *slip = INFINITY;
    if (!(of.lo >= own->lo[2] && of.hi <= own->hi[2])) return IMP_STATUS_OK;
    surface *made = under_one_more(s, k, box);
    if (made == NULL) return IMP_STATUS_OK;
    const imp_region times = region_make((double[3]){0, 0, of.lo}, (double[3]){0, 0, of.hi});
    const imp_region then = slip_at_times(&times, stand, stand);
    imp_status status = IMP_STATUS_OK;
    size_t maps = 0;
    double found = INFINITY;
    if (carried_exactly(made))
        status = slip_first_maps(made, true, bare, &times, &then, &maps, &found);
    if (status == IMP_STATUS_OK && maps == k + 1 && found >= 0) *slip = found;
    surface_free(made);
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

static bool is_followed(const surface *s)
{
    for (size_t k = 0; k < s->map_count; ++k)
        if (s->maps[k].origin->inner != NULL) return true;
    return false;
}

/* Lemma. Let s be closed about a line or a center and not move by itself, P_i(q) the first i maps,
 * which are exact rotations and shifts, each following time or a parameter of its own accord, q
 * these together, and c where they stand. Let each point of P_i-1(q) s be within e of one of
 * P_i-1(c) s, and each of that within e of one of P_i-1(q) s. A rotation or shift keeps distances,
 * so that with the map i, M(q_i), the same holds of P_i(q) s and M(q_i) P_i-1(c) s; and by the
 * lemma of slip_first_maps, for the one motion M(q_i) P_i-1(c), within its slip of M(q_i) P_i-1(c)
 * s and M(c_i) P_i-1(c) s = P_i(c) s. Thus e grows by the slip of the map alone. From q to other
 * times and values q' it is e to c and e from there, 2 e. */
imp_status surface_held_values(const surface *s, const surface_extent *extent, const value_box *box,
                               double enough, held_maps *held)
{
    imp_model bare[3];
    double sum = 0;
    *held = (held_maps){0, 0};
    if (s->origin->inner != NULL || !(extent->speed == 0) || !is_followed(s)) return IMP_STATUS_OK;
    for (int i = 0; i < 3; ++i) {
        if (!(extent->lo[i] > -INFINITY && extent->hi[i] < INFINITY)) return IMP_STATUS_OK;
        bare[i] = imp_between(extent->lo[i], extent->hi[i]);
    }
    for (size_t k = 0; k < s->map_count; ++k) {
        double slip;
        const imp_status status = slip_of_map(s, k, bare, box, &slip);
        if (status != IMP_STATUS_OK) return status;
        sum = sum_upper(sum, slip);
        if (!(2 * sum <= enough)) break;
        if (s->maps[k].origin->inner != NULL) *held = (held_maps){k + 1, 2 * sum};
    }
    return IMP_STATUS_OK;
}
