/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <stddef.h>

#include "core/base/rounding.h"
#include "core/surface/region.h"
#include "core/surface/surface_internal.h"

bool surface_has_distance(const surface *s)
{
    return IMP_OFFERS(s->type, distance) && (s->map_count == 0 || surface_is_rigid(s));
}

size_t surface_map_count(const surface *s) { return s->map_count; }

size_t surface_common_maps(const surface *a, const surface *b)
{
    size_t n = 0;
    while (n < a->map_count && n < b->map_count &&
           a->maps[a->map_count - 1 - n].origin == b->maps[b->map_count - 1 - n].origin)
        ++n;
    return n;
}

size_t surface_common_motion(const surface *a, const surface *b)
{
    const size_t common = surface_common_maps(a, b);
    size_t n = 0;
    while (n < common && IMP_OFFERS(a->maps[a->map_count - 1 - n].type, rigid) &&
           map_turns_exactly(&a->maps[a->map_count - 1 - n]))
        ++n;
    return n;
}

imp_status surface_still_maps(const surface *s, const imp_region *region, size_t *count)
{
    imp_pose pose;
    for (*count = 0; *count < s->map_count; ++*count) {
        const imp_status status = surface_pose_of_maps(s, *count, *count + 1, region, &pose);
        if (status == IMP_STATUS_UNBOUNDED || (status == IMP_STATUS_OK && pose_turns(&pose))) break;
        if (status != IMP_STATUS_OK) return status;
    }
    return IMP_STATUS_OK;
}

/* --- How far a pose is from rigid ------------------------------------------------------------- */

/* Bounds of D = R^T R - 1, R being the true rotation that a pose encloses. */
typedef struct deviation {
    double most[3][3]; /* >= |D_ij| at all times */
    double row[3];     /* >= sums of its rows */
    double norm; /* >= |D x| / |x|, in the greatest and in the Euclidean norm, as D is symmetric */
} deviation;

/* Lemma. D_ij is the product of the columns i and j of R less that of the identity, which lies in
 * the range of the same expression of the models, since they contain R. And with e =
 * IMP_RIGID_SLACK, each of the K maps alone changes squares of lengths by a factor from 1 - 3 e to
 * 1 + 3 e (surface_pose_norm_upper), all of them together from (1 - 3 e)^K to (1 + 3 e)^K, so that
 *
 *   |D_ij| <= |D| = max ||R x|^2 / |x|^2 - 1| <= (1 + 3 e)^K - 1 <= n^2 - 1,   n = (1 + 2 e)^K,
 *
 * since 1 - (1 - x)^K <= (1 + x)^K - 1. (1 + 2 e)^2 exceeds 1 + 3 e by more than e, which outweighs
 * the roundings of n, its square and the difference. A row sums up three entries, by two
 * roundings. */
PAD_COVERS(4, 2);
static deviation deviation_of(const imp_pose *pose, double norm)
{
    deviation d = {.norm = 0};
    imp_model column[3][3];
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) column[j][i] = pose->turn[i][j];
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            const imp_model entry = imp_shift(imp_dot3(column[i], column[j]), -(double)(i == j));
            const double found = imp_interval_mag(imp_model_range(&entry)), most = norm * norm - 1;
            d.most[i][j] = d.most[j][i] = found < most ? found : most;
        }
    }
    for (int i = 0; i < 3; ++i) {
        d.row[i] = padded_upper(d.most[i][0] + d.most[i][1] + d.most[i][2], 4);
        if (d.row[i] > d.norm) d.norm = d.row[i];
    }
    return d;
}

double surface_pose_deviation_upper(const imp_pose *pose)
{
    return deviation_of(pose, 1 + 2 * IMP_RIGID_SLACK).norm;
}

/* Returns a lower bound of |R x| / |x|, at most 1. Lemma. |R x|^2 >= (1 - |D|) |x|^2, and the root
 * of a number below 1 exceeds it. Also each map stretches by at least sqrt(1 - 3 e), and (1 + 2
 * e)^2 (1 - 3 e) > 1 + e / 2, so that 1 / n is below the product over all maps. */
static double least_stretch(const deviation *d, double norm)
{
    const double found = difference_lower(1, d->norm);
    return found > 1 / norm ? found : 1 / norm;
}

/* --- Before the maps -------------------------------------------------------------------------- */

/* Lemma. Let x = T + R (y - p) + r be a point that moves, y any point of the surface before the
 * maps, and z = R^-1 (x - T). Then x - (T + R (y - p)) = R (z + p - y), whose length is at least
 * that of z + p - y times the least stretch of R: so the distance of z + p from the surface before
 * the maps bounds that of x from it after them. Of z, R^T (x - T) = R^T R z = z + D z is known. Let
 * X_i >= |(R^T (x - T))_i| and d >= |D| in the greatest norm, d < 1. From z = R^T (x - T) - D z,
 *
 *   |z_i| <= X_i + row_i Z,   Z = max X / (1 - d) >= max |z_i|,   |(D z)_i| <= sum_j |D_ij| |z_j|.
 *
 * Roundings: 1 - d, quotient; product, sum; product, two sums. Underflows lose less than
 * PRODUCTS_UNDERFLOW. */
PAD_COVERS(16, 2 + 2 + 3);
static bool take_back(const imp_pose *pose, const deviation *d, const imp_model point[3],
                      imp_model at[3])
{
    imp_model way[3];
    double reach[3], most = 0;
    if (!(d->norm <= 0.5)) return false;
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(point[i], pose->shift[i]);
    for (int j = 0; j < 3; ++j) {
        const imp_model column[3] = {pose->turn[0][j], pose->turn[1][j], pose->turn[2][j]};
        at[j] = imp_dot3(column, way);
        reach[j] = imp_interval_mag(imp_model_range(&at[j]));
        if (!(reach[j] <= most)) most = reach[j];
    }
    const double all = most / (1 - d->norm);
    for (int i = 0; i < 3; ++i) {
        double slack = 0;
        for (int j = 0; j < 3; ++j) slack += d->most[i][j] * (reach[j] + d->row[j] * all);
        if (d->norm != 0) slack = padded_upper(slack, 16) + PRODUCTS_UNDERFLOW;
        at[i] = imp_add(imp_shift(at[i], pose->pivot[i]), imp_between(-slack, slack));
        if (!(at[i].e < INFINITY && at[i].lo > -INFINITY && at[i].hi < INFINITY)) return false;
    }
    return true;
}

/* --- The callback ----------------------------------------------------------------------------- */

/* Checks a distance. With a NaN or an infinity among the coefficients there is no bound; no finite
 * point is at an infinite distance. */
static imp_status check_distance(imp_status status, const imp_model *distance)
{
    if (status != IMP_STATUS_OK) return status;
    if (!(distance->e >= 0 && distance->lo <= distance->hi)) return SURFACE_BAD_DISTANCE;
    if (!(distance->lo < INFINITY && distance->hi > -INFINITY)) return SURFACE_BAD_DISTANCE;
    double sum = fabs(distance->a) + distance->e;
    for (int j = 0; j < 3; ++j) sum += fabs(distance->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(distance->q[k]);
    return sum < INFINITY ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static imp_status distance_before_maps(const surface *s, const imp_region *region,
                                       const imp_model point[3], imp_model *distance)
{
    const imp_model at[4] = {point[0], point[1], point[2], surface_time(region)};
    const surface_call call = surface_call_begin(s->type->name, "distance");
    const imp_status status = s->type->distance(s->self, at, distance);
    return check_distance(surface_call_end(call, status), distance);
}

/* Multiplies *stretch by the least stretch of the maps from `first` on, if they are all rigid at
 * these times. For maps that turn with time, the bound per map of the ABI is used: the remainders
 * of their models are larger. */
static imp_status stretch_by(const surface *s, size_t first, const imp_region *region,
                             double *stretch)
{
    const double norm = 1 + 2 * IMP_RIGID_SLACK; /* of one map; exact */
    for (size_t k = first; k < s->map_count; ++k) {
        imp_pose pose;
        const imp_status status = surface_pose_of_maps(s, k, k + 1, region, &pose);
        if (status != IMP_STATUS_OK) return status;
        double least = map_turns_exactly(&s->maps[k]) ? 1 : 1 / norm;
        if (least < 1 && !pose_turns(&pose)) {
            const deviation d = deviation_of(&pose, norm);
            least = least_stretch(&d, norm);
        }
        if (least < 1) *stretch = nextafter(*stretch * least, 0);
    }
    return IMP_STATUS_OK;
}

/* Takes the point back before the first `maps` maps, and bounds their least stretch. */
static imp_status take_back_before(const surface *s, size_t maps, const imp_region *region,
                                   const imp_model point[3], imp_model at[3], double *stretch)
{
    imp_pose pose;
    const double norm = surface_pose_norm_upper(s);
    const imp_status status = surface_pose_of_maps(s, 0, maps, region, &pose);
    if (status != IMP_STATUS_OK) return status;
    const deviation d = deviation_of(&pose, norm);
    *stretch = least_stretch(&d, norm);
    return take_back(&pose, &d, point, at) ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

/* Lemma. Rigid maps that follow on both surfaces multiply the distance of any two points at the
 * same time by at least their least stretch: |g| times that of all maps is no more than the
 * distance after them. imp_scale adds its rounding to g, which may depend on any parameter. */
static imp_status stretched(const surface *s, const imp_region *region, const imp_model at[3],
                            double stretch, imp_model *distance)
{
    const imp_status status = distance_before_maps(s, region, at, distance);
    if (status != IMP_STATUS_OK) return status;
    distance->depends = 7;
    for (int j = 0; j < 3; ++j) distance->rate[j] = INFINITY;
    *distance = imp_scale(*distance, stretch);
    return IMP_STATUS_OK;
}

static bool exists_during(const surface *s, const imp_region *region)
{
    return s->lo[2] <= region->lo[2] && region->hi[2] <= s->hi[2];
}

/* --- Planes ----------------------------------------------------------------------------------- */

/* Returns the model of n.(x - center) for models of x. */
static imp_model height_of(const surface_plane *plane, const imp_model x[3])
{
    imp_model axis[3], way[3];
    for (int i = 0; i < 3; ++i) {
        axis[i] = imp_num(plane->axis[i]);
        way[i] = imp_shift(x[i], -plane->center[i]);
    }
    return imp_dot3(axis, way);
}

imp_status surface_plane_of(const surface *s, const imp_region *region, surface_plane *plane)
{
    imp_model x[3];
    double length = 0;
    *plane = (surface_plane){.off = INFINITY};
    const imp_status status = surface_include_bare(s, region, x);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        plane->center[i] = x[i].a;
        plane->axis[i] = x[j].b[0] * x[k].b[1] - x[k].b[0] * x[j].b[1];
        length += plane->axis[i] * plane->axis[i];
        if ((x[i].depends >> PARAMETER_T & 1) != 0) return IMP_STATUS_UNBOUNDED;
    }
    length = sqrt(length);
    if (!(length > 0x1p-300 && length < 0x1p300)) return IMP_STATUS_UNBOUNDED;
    for (int i = 0; i < 3; ++i) plane->axis[i] /= length;
    const imp_model height = height_of(plane, x);
    plane->off = imp_interval_mag(imp_model_range(&height));
    return IMP_STATUS_OK;
}

/* Lemma. |n| <= 1 + 8 u, as n is a quotient by the root of a sum of squares. With y a point of the
 * part and z one within `slip` of x,
 *
 *   |n.(x - center)| <= |n.(z - y)| + |n.(y - center)| + |n.(x - z)|
 *                    <= (1 + 8 u) (|z - y| + slip) + off. */
PAD_COVERS(32, 8);
static imp_model lowered(const surface_plane *plane, double slip, double stretch, imp_model height)
{
    const double room = sum_upper(plane->off, padded_upper(slip, 32));
    return imp_scale(imp_add(height, imp_between(-room, room)), stretch * (1 - 0x1p-48));
}

imp_status surface_height_within(const surface *s, const surface_plane *plane,
                                 const imp_region *region, const imp_model point[3], double moment,
                                 double slip, imp_model *height)
{
    imp_model at[3] = {point[0], point[1], point[2]};
    double stretch = 1, unused;
    imp_status status = IMP_STATUS_OK;
    if (!exists_during(s, region)) return IMP_STATUS_UNBOUNDED;
    const imp_region then = region_make((double[3]){region->lo[0], region->lo[1], moment},
                                        (double[3]){region->hi[0], region->hi[1], moment});
    if (s->map_count > 0) status = take_back_before(s, s->map_count, &then, point, at, &unused);
    if (status == IMP_STATUS_OK) status = stretch_by(s, 0, region, &stretch);
    if (status != IMP_STATUS_OK) return status;
    *height = lowered(plane, slip, stretch, height_of(plane, at));
    height->depends = 7;
    for (int j = 0; j < 3; ++j) height->rate[j] = INFINITY;
    return check_distance(IMP_STATUS_OK, height);
}

imp_status surface_distance(const surface *s, const imp_region *region, size_t maps,
                            const imp_model point[3], imp_model *distance)
{
    imp_model at[3] = {point[0], point[1], point[2]};
    double stretch = 1;
    imp_status status = IMP_STATUS_OK;
    if (!exists_during(s, region)) return IMP_STATUS_UNBOUNDED;
    if (s->map_count == 0) return distance_before_maps(s, region, point, distance);
    if (maps > 0) status = take_back_before(s, maps, region, point, at, &stretch);
    if (status == IMP_STATUS_OK) status = stretch_by(s, maps, region, &stretch);
    return status == IMP_STATUS_OK ? stretched(s, region, at, stretch, distance) : status;
}

/* Lemma. The point is taken back by the maps at the moment. At every time of the region the claim
 * about it holds for the point of a (surface_slip, surface_carry_slip) taken back by the maps at
 * that time, and these multiply the distance by at least their least stretch at that time. */
imp_status surface_distance_within(const surface *s, const imp_region *region, size_t maps,
                                   const imp_model point[3], double moment, double slip,
                                   imp_model *distance)
{
    imp_model at[3] = {point[0], point[1], point[2]};
    double stretch = 1, unused;
    imp_status status = IMP_STATUS_OK;
    if (!exists_during(s, region)) return IMP_STATUS_UNBOUNDED;
    const imp_region then = region_make((double[3]){region->lo[0], region->lo[1], moment},
                                        (double[3]){region->hi[0], region->hi[1], moment});
    if (maps > 0) status = take_back_before(s, maps, &then, point, at, &unused);
    if (status == IMP_STATUS_OK) status = stretch_by(s, 0, region, &stretch);
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i) at[i] = imp_add(at[i], imp_between(-slip, slip));
    return stretched(s, region, at, stretch, distance);
}
