/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/scene/scene.h"
#include "core/surface/region.h"

/* What a program asks about one piece of a surface: points, enclosures, motion, domain. */

size_t imp_scene_piece_count(const imp_scene *scene, size_t body, size_t index)
{
    const surface *s = scene_surface(scene, body, index);
    return s != NULL ? surface_part_count(s) : 0;
}

const surface *scene_piece(const imp_scene *scene, imp_place at)
{
    const surface *s = scene_surface(scene, at.body, at.surface);
    if (s == NULL || at.piece >= surface_part_count(s)) return NULL;
    return surface_part(s, at.piece);
}

/* Sets the error for a callback's status. A place outside the domain is the caller's fault. */
static imp_code refusal(const surface *s, imp_status status, imp_error *why)
{
    surface_fault(
        s, why, ": %s",
        status == IMP_STATUS_DOMAIN
            ? "is undefined there, or too large for a double, though that lies in its domain"
            : surface_status_message(s, status).text);
    if (status != IMP_STATUS_DOMAIN) return surface_set_code(status, why);
    if (why != NULL) why->code = IMP_ERROR_USAGE;
    return IMP_ERROR_USAGE;
}

/* Sets the error for the first of n points that lies outside the domain. IMP_SUCCESS: all lie
 * inside. */
static imp_code refuse_outside(const surface *s, size_t n, const double *p, imp_error *why)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    for (; n > 0; --n, p += 3) {
        bool inside = true;
        for (int j = 0; j < 3; ++j) inside = inside && lo[j] <= p[j] && p[j] <= hi[j];
        if (inside) continue;
        surface_fault(s, why,
                      ": got (u, v, t) = (%g, %g, %g), must be in its domain, u in [%g, %g], "
                      "v in [%g, %g], t in [%g, %g]",
                      p[0], p[1], p[2], lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
        if (why != NULL) why->code = IMP_ERROR_USAGE;
        return IMP_ERROR_USAGE;
    }
    return IMP_SUCCESS;
}

static imp_code no_surface(const imp_scene *scene, imp_place at, imp_error *why)
{
    const size_t pieces = imp_scene_piece_count(scene, at.body, at.surface);
    if (pieces > 0)
        return error_set(why, IMP_ERROR_USAGE, "body %zu, surface %zu has no piece %zu, but %zu",
                         at.body, at.surface, at.piece, pieces);
    return error_set(why, IMP_ERROR_USAGE, "body %zu has no surface %zu", at.body, at.surface);
}

FP_APART static imp_code eval(const imp_scene *scene, imp_place at, size_t n, const double *p,
                              double *x, double *error, imp_error *why)
{
    const surface *s = scene_piece(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    const imp_status status = surface_eval(s, n, p, x, error);
    if (status == IMP_STATUS_DOMAIN && refuse_outside(s, n, p, why) != IMP_SUCCESS)
        return IMP_ERROR_USAGE;
    return status == IMP_STATUS_OK ? IMP_SUCCESS : refusal(s, status, why);
}

static bool is_inside(const surface *s, const double lo[3], const double hi[3])
{
    double from[3], to[3];
    surface_domain(s, from, to);
    for (int j = 0; j < 3; ++j)
        if (!(lo[j] >= from[j] && lo[j] <= hi[j] && hi[j] <= to[j] && isfinite(lo[j]) &&
              isfinite(hi[j])))
            return false;
    return true;
}

FP_APART static imp_code include(const imp_scene *scene, imp_place at, const double lo[3],
                                 const double hi[3], imp_model model[3], imp_error *why)
{
    const surface *s = scene_piece(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    if (!is_inside(s, lo, hi))
        return error_set(why, IMP_ERROR_USAGE,
                         "body %zu, surface %zu: region (%g..%g, %g..%g, %g..%g), must be finite "
                         "and inside the domain",
                         at.body, at.surface, lo[0], hi[0], lo[1], hi[1], lo[2], hi[2]);
    const imp_region region = region_make(lo, hi);
    const imp_status status = surface_include(s, &region, model);
    return status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED ? IMP_SUCCESS
                                                                     : refusal(s, status, why);
}

imp_code imp_piece_eval(const imp_scene *scene, imp_place at, size_t n, const double *p, double *x,
                        double *error, imp_error *why)
{
    if (scene == NULL || p == NULL || x == NULL) return error_set_missing(why, "imp_scene_eval");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = eval(scene, at, n, p, x, error, why);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_scene_eval(const imp_scene *scene, size_t body, size_t index, size_t n,
                        const double *p, double *x, double *error, imp_error *why)
{
    return imp_piece_eval(scene, (imp_place){body, index, 0}, n, p, x, error, why);
}

imp_code imp_piece_include(const imp_scene *scene, imp_place at, const double lo[3],
                           const double hi[3], imp_model model[3], imp_error *why)
{
    if (scene == NULL || lo == NULL || hi == NULL || model == NULL)
        return error_set_missing(why, "imp_scene_include");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = include(scene, at, lo, hi, model, why);
    fp_environment_leave(&environment);
    return code;
}

imp_code imp_scene_include(const imp_scene *scene, size_t body, size_t index, const double lo[3],
                           const double hi[3], imp_model model[3], imp_error *why)
{
    return imp_piece_include(scene, (imp_place){body, index, 0}, lo, hi, model, why);
}

FP_APART static imp_code piece_motion(const imp_scene *scene, imp_place at, double from, double to,
                                      imp_rigid_motion *motion, imp_error *why)
{
    double lo[3], hi[3];
    const surface *s = scene_piece(scene, at);
    if (s == NULL) return no_surface(scene, at, why);
    surface_domain(s, lo, hi);
    const double first = from < to ? from : to, last = from < to ? to : from;
    if (!(lo[2] <= first && last <= hi[2] && isfinite(first) && isfinite(last)))
        return error_set(
            why, IMP_ERROR_USAGE,
            "body %zu, surface %zu: times %g and %g, must be finite and in the domain, "
            "from %g to %g",
            at.body, at.surface, from, to, lo[2], hi[2]);
    surface_motion(s, from, to, motion);
    return IMP_SUCCESS;
}

imp_code imp_piece_motion(const imp_scene *scene, imp_place at, double from, double to,
                          imp_rigid_motion *motion, imp_error *why)
{
    if (scene == NULL || motion == NULL) return error_set_missing(why, "imp_piece_motion");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = piece_motion(scene, at, from, to, motion, why);
    fp_environment_leave(&environment);
    return code;
}

void imp_piece_domain(const imp_scene *scene, imp_place at, double lo[3], double hi[3])
{
    const surface *s = scene_piece(scene, at);
    if (lo == NULL || hi == NULL) return;
    for (int j = 0; j < 3; ++j) lo[j] = INFINITY, hi[j] = -INFINITY;
    if (s != NULL) surface_domain(s, lo, hi);
}

void imp_scene_domain(const imp_scene *scene, size_t body, size_t index, double lo[3], double hi[3])
{
    imp_piece_domain(scene, (imp_place){body, index, 0}, lo, hi);
}
