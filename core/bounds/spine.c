/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/spine.h"

#include <impinge/model.h>
#include <string.h>

#include "core/surface/carried.h"
#include "core/surface/course.h"
#include "core/surface/course_line.h"
#include "core/tree/node_model.h"

/* --- Lines about which a surface may turn ----------------------------------------------------- */

/* Nothing here is a bound: any line will do. */

enum { MOMENTS = 3, SAMPLES = 32, SAMPLES_ALONG = 5 };
static const double moments[MOMENTS] = {0.5, 0.81, 0.23};

static double moment_of(const time_window *times, double part)
{
    const double t = (1 - part) * times->lo + part * times->hi;
    return t < times->lo ? times->lo : t > times->hi ? times->hi : t;
}

/* The inverse of what the maps from `inner` to the one before `end` do at t. False: a callback
 * refuses. */
static bool inverse_at(const surface *s, size_t inner, size_t end, double t, rigid_numbers *m)
{
    surface first = *s;
    rigid_numbers at;
    first.map_count = end;
    if (!course_place_at(&first, inner, t, &at)) return false;
    for (int i = 0; i < 3; ++i) {
        m->shift[i] = 0;
        for (int k = 0; k < 3; ++k) {
            m->turn[i][k] = at.turn[k][i];
            m->shift[i] -= at.turn[k][i] * at.shift[k];
        }
    }
    return true;
}

/* The line about which the maps from `inner` to the one before `end` turn the surface. */
static bool line_of_maps(const surface *s, size_t inner, size_t end, const time_window *times,
                         spine *line)
{
    rigid_numbers m[MOMENTS];
    double best = SINE_LEAST;
    for (int k = 0; k < MOMENTS; ++k)
        if (!inverse_at(s, inner, end, moment_of(times, moments[k]), &m[k])) return false;
    for (int k = 1; k < MOMENTS; ++k) {
        double center[3], axis[3];
        const double sine = course_line_between(&m[0], &m[k], center, axis);
        if (!(sine > best)) continue;
        best = sine;
        memcpy(line->center, center, sizeof center);
        memcpy(line->axis, axis, sizeof axis);
    }
    return best > SINE_LEAST;
}

static bool line_of_motion(const surface *s, const time_window *times, spine *line)
{
    bool found = false;
    for (size_t end = line->inner + 1; end <= surface_map_count(s) && !found; ++end)
        found = line_of_maps(s, line->inner, end, times, line);
    return found;
}

static bool line_of_type(const surface *s, spine *line)
{
    imp_symmetry of;
    if (line->inner > 0 || surface_piece_count(s) > 0 || !surface_has_symmetry(s)) return false;
    if (surface_symmetry(s, &of) != IMP_STATUS_OK || of.kind == IMP_SYMMETRY_ABOUT_POINT)
        return false;
    const vec3 axis = vec3_from(of.axis);
    memcpy(line->center, of.center, sizeof of.center);
    memcpy(line->axis, vec3_scale(axis, 1 / vec3_norm(axis)).x, sizeof of.axis);
    line->is_of_type = true;
    return true;
}

/* --- Some of a surface's points --------------------------------------------------------------- */

typedef struct points {
    double x[SAMPLES][3];
    size_t count;
} points;

static bool add_point(const surface *piece, size_t inner, double u, double v, double t, points *all)
{
    imp_model x[3];
    const imp_region at = region_make((double[3]){u, v, t}, (double[3]){u, v, t});
    if (surface_include_inner(piece, &at, inner, x) != IMP_STATUS_OK) return false;
    for (int i = 0; i < 3; ++i) all->x[all->count][i] = x[i].a;
    ++all->count;
    return true;
}

/* A grid of a surface, or the corners of some of its pieces. */
static bool take_points(const surface *s, size_t inner, double t, points *all)
{
    const size_t parts = surface_part_count(s);
    const int along = parts > 1 ? 2 : SAMPLES_ALONG;
    const size_t most = SAMPLES / (size_t)(along * along), some = parts < most ? parts : most;
    all->count = 0;
    for (size_t k = 0; k < some; ++k) {
        double lo[3], hi[3];
        const surface *piece = surface_part(s, k * parts / some);
        surface_domain(piece, lo, hi);
        for (int n = 0; n < along * along; ++n) {
            const double p = (double)(n / along) / (along - 1),
                         q = (double)(n % along) / (along - 1);
            const double u = (1 - p) * lo[0] + p * hi[0], v = (1 - q) * lo[1] + q * hi[1];
            if (!add_point(piece, inner, u, v, t, all)) return false;
        }
    }
    return true;
}

/* Segment and radius for some points. */
static void fit(const points *all, spine *line)
{
    const vec3 axis = vec3_from(line->axis);
    line->radius = 0;
    line->from = INFINITY;
    line->to = -INFINITY;
    for (size_t k = 0; k < all->count; ++k) {
        const vec3 from = vec3_sub(vec3_from(all->x[k]), vec3_from(line->center));
        const double z = vec3_dot(from, axis), q = vec3_norm(vec3_cross(from, axis));
        if (q > line->radius) line->radius = q;
        if (z < line->from) line->from = z;
        if (z > line->to) line->to = z;
    }
}

/* The middle of the points' box. */
static void take_middle(const points *all, double center[3])
{
    for (int i = 0; i < 3; ++i) {
        double lo = INFINITY, hi = -INFINITY;
        for (size_t k = 0; k < all->count; ++k) {
            if (all->x[k][i] < lo) lo = all->x[k][i];
            if (all->x[k][i] > hi) hi = all->x[k][i];
        }
        center[i] = 0.5 * lo + 0.5 * hi;
    }
}

/* A line through the middle of the points is tried, too: where one map turns and moves the surface,
 * as a table of poses does, the line about which both together turn it is none of its own. Such a
 * line turns with the surface where it is no other one, so it has to be much nearer. */
static const double nearer[2] = {0.999, 0.75};

bool spine_choose(const surface *s, const time_window *times, spine *found)
{
    const spine none = {.of = s, .inner = surface_inner_maps(s), .radius = INFINITY};
    spine of_type = none, of_motion = none;
    points all;
    const bool has_type = line_of_type(s, &of_type);
    const bool turns = line_of_motion(s, times, &of_motion);
    *found = none;
    if (!has_type && !turns) return false;
    if (!take_points(s, none.inner, moment_of(times, moments[0]), &all)) return false;
    if (has_type) fit(&all, &of_type), *found = of_type;
    for (int k = 0; k < 2 && turns; ++k) {
        if (k > 0) take_middle(&all, of_motion.center);
        fit(&all, &of_motion);
        if (of_motion.radius < nearer[k] * found->radius) *found = of_motion;
    }
    return found->radius < INFINITY;
}

/* --- Its points at other times ---------------------------------------------------------------- */

/* Lemma. Rigid maps take the point center + z axis to the image of the center plus z times the
 * turned axis. carried_after follows both; a direction that a map's turn leaves as it is has no
 * remainder there, whatever the angle. */
bool spine_node(const spine *of, double from, double to, imp_model x[3], node *n)
{
    carried center = {.off = 0};
    imp_model way[1][3];
    *n = (node){.surface = of->of};
    region_set(&n->region, (double[3]){0, of->from, from}, (double[3]){0, of->to, to});
    for (int i = 0; i < 3; ++i) {
        center.at[i] = imp_num(of->center[i]);
        way[0][i] = imp_num(of->axis[i]);
    }
    if (carried_after(of->of, of->inner, &n->region, &center, 1, way) != IMP_STATUS_OK)
        return false;
    const imp_model z = imp_param(&n->region, PARAMETER_V);
    for (int i = 0; i < 3; ++i) x[i] = imp_add(center.at[i], imp_mul(z, way[0][i]));
    return center.off == 0 && node_take_model(n, x, true) == NULL && n->bounded;
}
