/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/surface/surface_internal.h"
#include "core/surface/time_model.h"

bool surface_is_rigid(const surface *s)
{
    for (size_t k = 0; k < s->map_count; ++k)
        if (!IMP_OFFERS(s->maps[k].type, rigid)) return false;
    return s->map_count > 0;
}

/* Lemma. With D = R^T R - 1, |R x|^2 = |x|^2 + x^T D x <= |x|^2 (1 + 3 max |D_ij|), so that one map
 * lengthens x by a factor of at most 1 + 1.5 IMP_RIGID_SLACK; the rest of the factor 1 + 2
 * IMP_RIGID_SLACK far outweighs the rounding. */
double surface_pose_norm_upper(const surface *s)
{
    double norm = 1;
    for (size_t k = 0; k < s->map_count; ++k) norm *= 1 + 2 * IMP_RIGID_SLACK;
    return norm;
}

/* Whether the model is finite and depends on time alone. */
static bool is_sane(const imp_model *m)
{
    const double *b = m->b, *q = m->q;
    const double still = fabs(b[0]) + fabs(b[1]) + fabs(q[IMP_UU]) + fabs(q[IMP_UV]) +
                         fabs(q[IMP_UT]) + fabs(q[IMP_VV]) + fabs(q[IMP_VT]);
    const double all = zero_if_finite(m->a) + zero_if_finite(b[2]) + zero_if_finite(q[IMP_TT]) +
                       zero_if_finite(m->e) + zero_if_finite(m->lo) + zero_if_finite(m->hi) +
                       zero_if_finite(m->rate[2]);
    return still + all == 0 && m->e >= 0 && m->lo <= m->hi && m->rate[2] >= 0 &&
           (m->depends & 3u) == 0;
}

static imp_status judge(imp_status status, const imp_pose *pose)
{
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            if (!is_sane(&pose->turn[i][j])) return SURFACE_BAD_POSE;
        if (!is_sane(&pose->shift[i]) || !isfinite(pose->pivot[i])) return SURFACE_BAD_POSE;
        if (!(fabs(pose->fixed[i]) < 0x1p340)) return SURFACE_BAD_POSE;
    }
    return IMP_STATUS_OK;
}

bool pose_turns(const imp_pose *pose)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (pose->turn[i][j].depends) return true;
    return false;
}

/* Chooses the pivot of a pose that does not turn, for which any is right: the point that it moves
 * to the next map's pivot at the middle of the times is best. With any p',
 *
 *   shift + R (x - p) = (shift + R (p' - p)) + R (x - p') */
static void choose_pivot(const imp_pose *next, imp_pose *pose)
{
    double pivot[3];
    imp_model way[3];
    for (int j = 0; j < 3; ++j) {
        pivot[j] = pose->pivot[j];
        for (int i = 0; i < 3; ++i)
            pivot[j] += pose->turn[i][j].a * (next->pivot[i] - pose->shift[i].a);
        way[j] = imp_sub(imp_num(pivot[j]), imp_num(pose->pivot[j]));
    }
    for (int i = 0; i < 3; ++i)
        pose->shift[i] = imp_add(pose->shift[i], imp_dot3(pose->turn[i], way));
    memcpy(pose->pivot, pivot, sizeof pivot);
}

bool pose_turn_is_identity(const imp_pose *pose)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const imp_model *m = &pose->turn[i][j];
            if (m->depends != 0 || m->e != 0 || m->a != (i == j) || m->lo != m->hi) return false;
        }
    return true;
}

/* Composes `next`, with turn S, after `pose`, with turn R:
 *
 *   shift' + S (shift + R (x - p) - p') = (shift' + S (shift - p')) + S R (x - p) */
static void add_pose(imp_pose *next, double norm, imp_pose *pose)
{
    imp_pose all;
    imp_model way[3];
    const imp_model *const ways[3] = {&way[0], &way[1], &way[2]};
    if (pose_turns(next) && !pose_turns(pose)) choose_pivot(next, pose);
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(pose->shift[i], -next->pivot[i]);
    if (pose_turn_is_identity(next)) {
        for (int i = 0; i < 3; ++i) pose->shift[i] = imp_add(way[i], next->shift[i]);
        return; /* pose->fixed stays fixed */
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const imp_model *const column[3] = {&pose->turn[0][j], &pose->turn[1][j],
                                                &pose->turn[2][j]};
            all.turn[i][j] =
                time_within(time_dot3(next->turn[i], column), imp_interval_make(-norm, norm));
        }
        all.shift[i] = imp_add(time_dot3(next->turn[i], ways), next->shift[i]);
    }
    memcpy(all.pivot, pose->pivot, sizeof all.pivot);
    memset(all.fixed, 0, sizeof all.fixed);
    *pose = all;
}

imp_status surface_pose_of_maps(const surface *s, size_t first, size_t end,
                                const imp_region *region, imp_pose *pose)
{
    const imp_model t = surface_time(region);
    const double norm = surface_pose_norm_upper(s);
    imp_status status = IMP_STATUS_OK;
    for (size_t k = first; k < end && status == IMP_STATUS_OK; ++k) {
        const mapping *map = &s->maps[k];
        imp_pose next;
        memset(&next, 0, sizeof next);
        const surface_call call = surface_call_begin(map->type->name, "rigid");
        status = map->type->rigid(map->self, &t, &next);
        status = judge(surface_call_end(call, status), &next);
        if (status != IMP_STATUS_OK) return status;
        if (k == first)
            *pose = next;
        else
            add_pose(&next, norm, pose);
    }
    if (end - first == 1) return IMP_STATUS_OK;
    return judge(IMP_STATUS_OK, pose) == IMP_STATUS_OK ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

imp_status surface_pose(const surface *s, const imp_region *region, imp_pose *pose)
{
    return surface_pose_of_maps(s, 0, s->map_count, region, pose);
}
