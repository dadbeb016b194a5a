/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/surface/carried.h"

/* Returns an upper bound of |w|. Roundings: squares 1, sums 2, halved by the root, root 1. */
PAD_COVERS(8, 2 + 1);
double surface_size_upper(const imp_model w[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double x = imp_interval_mag(imp_model_range(&w[i]));
        sum += x * x;
    }
    return padded_upper(sqrt(sum), 8) + ROOT_UNDERFLOW;
}

/* Splits off from `way` the component along the direction f that the pose leaves fixed. Lemma. R f
 * = f, and R^T f = f where R is a rotation; so with w = c f + w', R w = c f + R w', and the
 * remainder of R multiplies w' alone: for a direction along the axis of the turn it is 0 up to
 * rounding, however far the pose turns. Any c is right. If the map is no exact rotation, R^T f
 * differs from f, and nothing is split off. */
static void take_along(const imp_pose *pose, imp_model way[3], imp_model along[3])
{
    imp_model f[3], c = imp_num(0);
    const double *g = pose->fixed, square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    for (int i = 0; i < 3; ++i) f[i] = imp_num(g[i]);
    if (square > AXIS_LEAST * AXIS_LEAST) c = imp_scale(imp_dot3(f, way), 1 / square);
    for (int i = 0; i < 3; ++i) {
        along[i] = imp_mul(c, f[i]);
        way[i] = imp_sub(way[i], along[i]);
    }
}

void carried_turn(const imp_pose *pose, imp_model way[3])
{
    imp_model along[3], turned[3];
    take_along(pose, way, along);
    for (int i = 0; i < 3; ++i) turned[i] = imp_add(imp_dot3(pose->turn[i], way), along[i]);
    memcpy(way, turned, sizeof turned);
}

/* Lemma. Let R be the turn of a map, R^T R = 1 + D with |D| <= d <= 1/2. Its polar decomposition is
 * U H with a rotation U, H = (1 + D)^(1/2) and |H - 1| <= d, since 1 - (1 - d)^(1/2) <= d. So
 *
 *   |R w - U w| = |(H - 1) w| <= d |w|,   |R^T w - U^T w| = |(H - 1) U^T w| <= d |w|,
 *
 * and the length of the point's previous error is unchanged under U. */
void carried_push(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3], along[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_shift(x->at[i], -pose->pivot[i]);
    x->off = sum_upper(x->off, d * surface_size_upper(way));
    take_along(pose, way, along);
    for (int i = 0; i < 3; ++i)
        x->at[i] = imp_add(imp_add(imp_dot3(pose->turn[i], way), along[i]), pose->shift[i]);
}

void carried_pull(const imp_pose *pose, double d, carried *x)
{
    imp_model way[3], along[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(x->at[i], pose->shift[i]);
    x->off = sum_upper(x->off, d * surface_size_upper(way));
    take_along(pose, way, along);
    for (int j = 0; j < 3; ++j) {
        const imp_model column[3] = {pose->turn[0][j], pose->turn[1][j], pose->turn[2][j]};
        x->at[j] = imp_shift(imp_add(imp_dot3(column, way), along[j]), pose->pivot[j]);
    }
}

/* Pulls back by R^-1 instead of R^T. Lemma. |R^-1 w| <= |w| / (1 - d)^(1/2) <= 2 |w|, and R^T w -
 * R^-1 w = D R^-1 w is no longer than 2 d |w|, as is R^-1 w - U^T w. */
void carried_pull_truly(const imp_pose *pose, double d, carried *x)
{
    carried_pull(pose, 2 * d, x);
    for (int j = 0; j < 3; ++j) x->at[j] = imp_add(x->at[j], imp_between(-x->off, x->off));
}

imp_status carried_pose(const surface *s, size_t k, const imp_region *times, imp_pose *pose,
                        double *d)
{
    const imp_status status = surface_pose_of_maps(s, k, k + 1, times, pose);
    if (status == IMP_STATUS_OK)
        *d = map_turns_exactly(&s->maps[k]) ? 0 : surface_pose_deviation_upper(pose);
    if (status == IMP_STATUS_OK && *d > 0) memset(pose->fixed, 0, sizeof pose->fixed);
    return status == IMP_STATUS_OK && !(*d <= 0.5) ? IMP_STATUS_UNBOUNDED : status;
}

bool carried_exactly(const surface *s)
{
    for (size_t k = 0; k < s->map_count; ++k)
        if (!IMP_OFFERS(s->maps[k].type, rigid) || !map_turns_exactly(&s->maps[k])) return false;
    return true;
}
