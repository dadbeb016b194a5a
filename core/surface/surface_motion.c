/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

/* --- Which first maps do not move the surface ------------------------------------------------- */

/* Returns the first map from which on all maps are rigid. */
static size_t first_rigid(const surface *s)
{
    size_t first = s->map_count;
    while (first > 0 && IMP_OFFERS(s->maps[first - 1].type, rigid)) --first;
    return first;
}

/* Lemma. A rate matrix bounds the derivatives in t over the region, so where its column of t is 0,
 * points under the first `maps` maps are the same at all of its times. Without bounds the surface
 * counts as moving. */
static bool stands_still(const surface *s, size_t maps, double from, double to)
{
    double lo[3], hi[3];
    imp_model model[3];
    surface_domain(s, lo, hi);
    lo[2] = from < to ? from : to, hi[2] = from < to ? to : from;
    const imp_region region = region_make(lo, hi);
    if (surface_include_inner(s, &region, maps, model) != IMP_STATUS_OK) return false;
    return model[0].rate[2] == 0 && model[1].rate[2] == 0 && model[2].rate[2] == 0;
}

/* --- Poses of single moments ------------------------------------------------------------------ */

/* x -> turn x + shift. */
typedef struct placement {
    double turn[3][3], shift[3];
} placement;

/* A pose whose remainders exceed this, in radians and relative to its shift, is not used. */
static const double pose_slack = 1e-9;

static bool is_exact(const imp_model *m, double size) { return m->e <= pose_slack * (1 + size); }

/* Writes shift + turn (x - pivot) as turn x + (shift - turn pivot). False: there is no pose, or one
 * that is not exact enough. */
static bool place_at(const surface *s, size_t first, double t, placement *at)
{
    double lo[3], hi[3];
    imp_pose pose;
    surface_domain(s, lo, hi);
    lo[2] = hi[2] = t;
    const imp_region region = region_make(lo, hi);
    if (surface_pose_of_maps(s, first, s->map_count, &region, &pose) != IMP_STATUS_OK) return false;
    bool exact = true;
    for (int i = 0; i < 3; ++i) {
        at->shift[i] = pose.shift[i].a;
        exact &= is_exact(&pose.shift[i], fabs(pose.shift[i].a));
        for (int j = 0; j < 3; ++j) {
            at->turn[i][j] = pose.turn[i][j].a;
            at->shift[i] -= pose.turn[i][j].a * pose.pivot[j];
            exact &= is_exact(&pose.turn[i][j], 0);
        }
    }
    return exact;
}

/* Computes the rows of the inverse by cross products of columns. It exists, since `turn` is within
 * IMP_RIGID_SLACK of a rotation. */
static void invert(double m[3][3], double inverse[3][3])
{
    double determinant = 0;
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3, b = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const int c = (j + 1) % 3, d = (j + 2) % 3;
            inverse[i][j] = m[c][a] * m[d][b] - m[d][a] * m[c][b];
        }
    }
    for (int j = 0; j < 3; ++j) determinant += m[0][j] * inverse[j][0];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) inverse[i][j] /= determinant;
}

/* With y the point before the rigid maps, x_from = A y + a and x_to = B y + b, so that
 * x_to = B A^-1 x_from + (b - B A^-1 a). */
static void compose(placement *from, const placement *to, imp_rigid_motion *motion)
{
    double inverse[3][3];
    invert(from->turn, inverse);
    for (int i = 0; i < 3; ++i) {
        motion->shift[i] = to->shift[i];
        for (int j = 0; j < 3; ++j) {
            motion->turn[i][j] = 0;
            for (int k = 0; k < 3; ++k) motion->turn[i][j] += to->turn[i][k] * inverse[k][j];
            motion->shift[i] -= motion->turn[i][j] * from->shift[j];
        }
    }
}

bool surface_motion(const surface *s, double from, double to, imp_rigid_motion *motion)
{
    placement a, b;
    const size_t first = first_rigid(s);
    *motion = (imp_rigid_motion){.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    motion->is_known = stands_still(s, first, from, to);
    if (!motion->is_known || first == s->map_count || from == to) return motion->is_known;
    motion->is_known = place_at(s, first, from, &a) && place_at(s, first, to, &b);
    if (motion->is_known) compose(&a, &b, motion);
    return motion->is_known;
}
