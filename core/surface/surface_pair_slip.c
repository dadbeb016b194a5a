/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/slip.h"

static double slack_of(const imp_symmetry *found, const imp_model bare[3])
{
    const double lo[3] = {bare[0].lo, bare[1].lo, bare[2].lo},
                 hi[3] = {bare[0].hi, bare[1].hi, bare[2].hi};
    return symmetry_slack_upper(found, lo, hi);
}

/* Lemma. Let P(t) be the motion by the first maps of s. In the lemma of slip_upper let b be s
 * under these maps, and a be P(t0) s at rest. Then the points of P(t0) s are within `slip` of P(t)
 * s, and those of P(t) s within `slip` of P(t0) s: F, which takes one center and axis to the
 * other, moves neither farther, and what is closed but for a slack has a point within that of each
 * image. So P(t) s may be replaced by P(t0) s if `slip` is subtracted from the distances that are
 * proved. */
static imp_status slip_of_first(const surface *s, size_t maps, const imp_symmetry *found,
                                const imp_model bare[3], const imp_region *times,
                                const imp_region *then, double *slip)
{
    imp_model there[3];
    surface rest = {.map_count = 0};
    memcpy(there, bare, sizeof there);
    for (size_t k = 0; k < maps; ++k) {
        imp_pose pose;
        double d;
        carried y = {.off = 0};
        const imp_status status = carried_pose(s, k, then, &pose, &d);
        if (status != IMP_STATUS_OK) return status;
        memcpy(y.at, there, sizeof y.at);
        carried_push(&pose, d, &y);
        for (int i = 0; i < 3; ++i) {
            const imp_interval range = imp_model_range(&y.at[i]);
            there[i] = imp_between(difference_lower(range.lo, y.off), sum_upper(range.hi, y.off));
        }
    }
    const slip_input q = {
        .a = &rest, .b = s, .b_maps = maps, .then = *then, .found = *found, .bare = there};
    const imp_status status = slip_find(&q, times, slip);
    *slip = sum_upper(*slip, slack_of(found, bare));
    return status;
}

imp_status slip_first_maps(const surface *s, bool of_pieces, const imp_model bare[3],
                           const imp_region *times, const imp_region *then, size_t *maps,
                           double *slip)
{
    imp_symmetry found;
    imp_status status = surface_closed_symmetry(s, of_pieces, &found);
    *maps = 0;
    *slip = 0;
    if (status != IMP_STATUS_OK) return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
    for (size_t k = s->map_count; k > 0; --k) {
        double found_slip;
        status = slip_of_first(s, k, &found, bare, times, then, &found_slip);
        if (status != IMP_STATUS_OK && status != IMP_STATUS_UNBOUNDED) return status;
        if (status != IMP_STATUS_OK || !(found_slip < INFINITY)) continue;
        *maps = k;
        *slip = found_slip;
        return IMP_STATUS_OK;
    }
    return IMP_STATUS_OK;
}

/* Bounds in *slip how far a's motion, as seen from b, leaves b's closed symmetry. Lemma. Where
 * that is closed but for a slack, a motion S of it changes no distance from b by more: S^-1 b has
 * a point within that of each of b, and b of each of S^-1 b. */
static imp_status slip_of_rest(const surface *const s[2], bool of_pieces, const size_t still[2],
                               const imp_model *const bare[2], const imp_region *times,
                               const imp_region *then, double *slip)
{
    slip_input q = {.a = s[0],
                    .b = s[1],
                    .a_maps = s[0]->map_count,
                    .b_maps = s[1]->map_count,
                    .a_still = still[0],
                    .b_still = still[1],
                    .then = *then,
                    .bare = bare[0]};
    *slip = INFINITY;
    imp_status status = surface_closed_symmetry(s[1], of_pieces, &q.found);
    if (status == IMP_STATUS_OK) status = slip_find(&q, times, slip);
    if (status == IMP_STATUS_OK) *slip = sum_upper(*slip, slack_of(&q.found, bare[1]));
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

/* >= how far points of s are at these times from where they would be, if each of its maps turned
 * them as the rotation next to its turn does (carried_push). */
static imp_status off_of(const surface *s, const imp_model bare[3], const imp_region *times,
                         double *off)
{
    carried y = {.off = 0};
    imp_status status = IMP_STATUS_OK;
    bool is_exact = true;
    for (size_t k = 0; k < s->map_count; ++k) is_exact = is_exact && map_turns_exactly(&s->maps[k]);
    for (int i = 0; i < 3; ++i) y.at[i] = imp_between(bare[i].lo, bare[i].hi);
    for (size_t k = 0; k < s->map_count && !is_exact && status == IMP_STATUS_OK; ++k) {
        imp_pose pose;
        double d;
        status = carried_pose(s, k, times, &pose, &d);
        if (status == IMP_STATUS_OK) carried_push(&pose, d, &y);
    }
    *off = y.off;
    return status;
}

/* Adds to *slip how much maps that are only nearly rotations may change the distance. Lemma.
 * slip_of_first and slip_of_rest bound motions in which rotations, which preserve distances,
 * replace the maps' turns. Under the maps themselves points of either surface are off by at most
 * its `off`, at any of the times and at the moment: so each of the two distances is off by at most
 * the sum of both surfaces' `off`. */
static imp_status add_off(const surface *const s[2], const imp_model bare[2][3],
                          const imp_region *times, double *slip)
{
    imp_status status = IMP_STATUS_OK;
    for (int k = 0; k < 2 && status == IMP_STATUS_OK; ++k) {
        double off;
        status = off_of(s[k], bare[k], times, &off);
        if (status == IMP_STATUS_OK && off > 0) *slip = sum_upper(*slip, 2 * off);
    }
    if (status != IMP_STATUS_OK || !(*slip >= 0)) *slip = INFINITY;
    return status == IMP_STATUS_UNBOUNDED ? IMP_STATUS_OK : status;
}

imp_status surface_pair_slip(const surface *const s[2], bool of_pieces, const imp_model bare[2][3],
                             const imp_region *times, double moment, double *slip, int *asked)
{
    const imp_region then = slip_at_times(times, moment, moment);
    size_t still[2];
    double own[2], rest = 0;
    *slip = INFINITY;
    if (!slip_moves_rigidly(s[0]) || !slip_moves_rigidly(s[1])) return IMP_STATUS_OK;
    for (int k = 0; k < 2; ++k) {
        *asked = k;
        const imp_status status =
            slip_first_maps(s[k], of_pieces, bare[k], times, &then, &still[k], &own[k]);
        if (status != IMP_STATUS_OK) return status;
    }
    if (still[0] < s[0]->map_count || still[1] < s[1]->map_count) {
        imp_status status = slip_of_rest(
            s, of_pieces, still, (const imp_model *[]){bare[0], bare[1]}, times, &then, &rest);
        if (status == IMP_STATUS_OK && !(rest < INFINITY)) {
            const surface *const turned[2] = {s[1], s[0]};
            *asked = 0;
            status = slip_of_rest(turned, of_pieces, (size_t[2]){still[1], still[0]},
                                  (const imp_model *[]){bare[1], bare[0]}, times, &then, &rest);
        }
        if (status != IMP_STATUS_OK) return status;
    }
    *slip = sum_upper(sum_upper(own[0], own[1]), rest);
    return *slip < INFINITY ? add_off(s, bare, times, slip) : IMP_STATUS_OK;
}
