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

/* Turns a direction by the map of this pose, whose turn is an exact rotation. */
static void turn(const imp_pose *pose, imp_model way[3])
{
    imp_model along[3], turned[3];
    take_along(pose, way, along);
    for (int i = 0; i < 3; ++i) turned[i] = imp_add(imp_dot3(pose->turn[i], way), along[i]);
    memcpy(way, turned, sizeof turned);
}

/* Turns a direction by R^T. */
static void turn_back(const imp_pose *pose, imp_model way[3])
{
    imp_model along[3], turned[3];
    take_along(pose, way, along);
    for (int j = 0; j < 3; ++j) {
        const imp_model column[3] = {pose->turn[0][j], pose->turn[1][j], pose->turn[2][j]};
        turned[j] = imp_add(imp_dot3(column, way), along[j]);
    }
    memcpy(way, turned, sizeof turned);
}

/* Lemma. Let R be the turn of a map, R^T R = 1 + D with |D| <= d <= 1/2. Its polar decomposition is
 * U H with a rotation U, H = (1 + D)^(1/2) and |H - 1| <= d, since 1 - (1 - d)^(1/2) <= d. So
 *
 *   |R w - U w| = |(H - 1) w| <= d |w|,   |R^T w - U^T w| = |(H - 1) U^T w| <= d |w|,
 *
 * and the length of the previous error, of a point or a direction, is unchanged under U. */
static void add_off(double d, const imp_model way[3], double *off)
{
    if (d > 0) *off = sum_upper(*off, d * surface_size_upper(way));
}

void carried_push(const imp_pose *pose, double d, carried *x)
{
    for (int i = 0; i < 3; ++i) x->at[i] = imp_shift(x->at[i], -pose->pivot[i]);
    add_off(d, x->at, &x->off);
    turn(pose, x->at);
    for (int i = 0; i < 3; ++i) x->at[i] = imp_add(x->at[i], pose->shift[i]);
}

void carried_pull(const imp_pose *pose, double d, carried *x)
{
    for (int i = 0; i < 3; ++i) x->at[i] = imp_sub(x->at[i], pose->shift[i]);
    add_off(d, x->at, &x->off);
    turn_back(pose, x->at);
    for (int j = 0; j < 3; ++j) x->at[j] = imp_shift(x->at[j], pose->pivot[j]);
}

/* Adds to the plane's height by how much that of the pose's shift, along the normal after the turn,
 * exceeds that of its pivot, along the normal before it; or takes it away. Lemma. Let x' = shift +
 * U (x - pivot) and n' = U n, U a rotation. n'.x' = n.x + n'.shift - n.pivot: no entry of U is in
 * this but by n', whose models have no remainder where n is the direction that U leaves fixed. The
 * normals are off by at most their `off`, and the height by that times the lengths. */
static void lift(const imp_pose *pose, const carried *before, const carried *after, bool is_back,
                 carried_plane *x)
{
    imp_model pivot[3];
    for (int i = 0; i < 3; ++i) pivot[i] = imp_num(pose->pivot[i]);
    const imp_model up = imp_sub(imp_dot3(after->at, pose->shift), imp_dot3(before->at, pivot));
    x->height = is_back ? imp_sub(x->height, up) : imp_add(x->height, up);
    if (before->off + after->off == 0) return;
    const double shift = surface_size_upper(pose->shift), own = surface_size_upper(pivot);
    x->off = sum_upper(x->off, padded_upper(after->off * shift + before->off * own, 8));
}
PAD_COVERS(8, 2); /* product, sum */

void carried_push_plane(const imp_pose *pose, double d, carried_plane *x)
{
    const carried before = x->normal;
    add_off(d, x->normal.at, &x->normal.off);
    turn(pose, x->normal.at);
    lift(pose, &before, &x->normal, false, x);
}

void carried_pull_plane(const imp_pose *pose, double d, carried_plane *x)
{
    const carried after = x->normal;
    add_off(d, x->normal.at, &x->normal.off);
    turn_back(pose, x->normal.at);
    lift(pose, &x->normal, &after, true, x);
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

imp_status carried_through(const surface *s, const imp_region *times, carried *x, size_t count,
                           imp_model way[][3])
{
    return carried_after(s, 0, times, x, count, way);
}

imp_status carried_after(const surface *s, size_t maps, const imp_region *times, carried *x,
                         size_t count, imp_model way[][3])
{
    for (size_t k = maps; k < s->map_count; ++k) {
        imp_pose pose;
        double d;
        const imp_status status = carried_pose(s, k, times, &pose, &d);
        if (status != IMP_STATUS_OK) return status;
        carried_push(&pose, d, x);
        for (size_t i = 0; i < count; ++i) turn(&pose, way[i]);
    }
    return IMP_STATUS_OK;
}
