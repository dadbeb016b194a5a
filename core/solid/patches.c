/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solid/patches.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/rounding.h"
#include "core/base/status.h"

#define COORDINATE_MAX 1e50 /* so that fifth powers do not overflow */

/* Returns a bound of the distance of points whose coordinates are off by at most e_i. Roundings:
 * squares, two sums, and a root, which halves the relative errors before it and adds its own. */
PAD_COVERS(8, 3);
static double length_upper(const double *e)
{
    return padded_upper(vec3_norm(vec3_from(e)), 8) + ROOT_UNDERFLOW;
}

imp_code patch_eval(const patch *p, double t, size_t n, const double (*uv)[2], vec3 *x,
                    double *errors, imp_error *error)
{
    double at[3 * PATCH_POINTS_MAX], found[3 * PATCH_POINTS_MAX], off[3 * PATCH_POINTS_MAX];
    assert(n <= PATCH_POINTS_MAX);
    for (size_t k = 0; k < n; ++k) {
        memcpy(at + 3 * k, uv[k], 2 * sizeof *at);
        at[3 * k + 2] = t;
    }
    const imp_status status = surface_eval(p->surface, n, at, found, errors != NULL ? off : NULL);
    if (status != IMP_STATUS_OK) {
        surface_fault(p->surface, error, "at t = %.17g: %s", t,
                      surface_status_message(p->surface, status).text);
        return surface_set_code(status, error);
    }
    for (size_t k = 0; k < n; ++k) x[k] = vec3_from(found + 3 * k);
    for (size_t k = 0; errors != NULL && k < n; ++k) errors[k] = length_upper(off + 3 * k);
    return IMP_SUCCESS;
}

imp_code patch_include(const patch *p, const imp_region *region, imp_model model[3],
                       imp_error *error)
{
    const surface *s = p->surface;
    const imp_status status = surface_include(s, region, model);
    if (status == IMP_STATUS_OK || status == IMP_STATUS_UNBOUNDED) return IMP_SUCCESS;
    surface_fault(s, error, "over u [%.17g, %.17g], v [%.17g, %.17g], t = %.17g: %s", region->lo[0],
                  region->hi[0], region->lo[1], region->hi[1], region->lo[2],
                  surface_status_message(s, status).text);
    return surface_set_code(status, error);
}

void patch_corner(const patch *p, int k, double at[2])
{
    at[0] = k == 1 || k == 2 ? p->hi[0] : p->lo[0];
    at[1] = k == 2 || k == 3 ? p->hi[1] : p->lo[1];
}

/* --- The list --------------------------------------------------------------------------------- */

static bool exists_at(const surface *s, double t)
{
    double lo, hi;
    surface_existence(s, &lo, &hi);
    return lo <= t && t <= hi;
}

static void add_patch(patches *p, const surface *s, imp_place place)
{
    double lo[3], hi[3];
    surface_domain(s, lo, hi);
    patch *one = &p->patch[p->count++];
    *one = (patch){.surface = s, .place = place, .lo = {lo[0], lo[1]}, .hi = {hi[0], hi[1]}};
    for (int k = 0; k < 2; ++k) p->bounded = p->bounded && hi[k] - lo[k] < INFINITY;
}

static void list_surface(patches *p, const surface *s, size_t body, size_t index)
{
    const size_t pieces = surface_piece_count(s);
    if (pieces == 0) add_patch(p, s, (imp_place){body, index, 0});
    for (size_t k = 0; k < pieces; ++k)
        add_patch(p, surface_piece(s, k), (imp_place){body, index, k});
}

/* Takes a few points of each patch into the box whose diagonal is the size. */
static imp_code measure(patches *p, imp_error *error)
{
    enum { ROWS = 5, POINTS = ROWS * ROWS };
    double lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    const int rows = p->count > 1024 ? 2 : ROWS;
    for (size_t i = 0; i < p->count; ++i) {
        const patch *one = &p->patch[i];
        double uv[POINTS][2];
        vec3 x[POINTS];
        for (int k = 0; k < rows * rows; ++k) {
            uv[k][0] = patch_between(one->lo[0], one->hi[0], k / rows, rows - 1);
            uv[k][1] = patch_between(one->lo[1], one->hi[1], k % rows, rows - 1);
        }
        const double(*points)[2] = (const double(*)[2])uv;
        const imp_code code = patch_eval(one, p->t, (size_t)(rows * rows), points, x, NULL, error);
        if (code != IMP_SUCCESS) return code;
        for (int k = 0; k < 3 * rows * rows; ++k) {
            const double c = x[k / 3].x[k % 3];
            p->bounded = p->bounded && fabs(c) <= COORDINATE_MAX;
            if (c < lo[k % 3]) lo[k % 3] = c;
            if (c > hi[k % 3]) hi[k % 3] = c;
        }
    }
    p->size = p->count > 0 ? vec3_norm(vec3_sub(vec3_from(hi), vec3_from(lo))) : 0;
    return IMP_SUCCESS;
}

size_t solid_patches_most(const imp_scene *scene, size_t body)
{
    size_t count = 0;
    for (size_t k = 0; k < scene_surface_count(scene, body); ++k)
        count += surface_piece_count(scene_surface(scene, body, k)) + 1;
    return count;
}

imp_code solid_patches_read(patches *p, const imp_scene *scene, size_t body, double t,
                            imp_error *error)
{
    const size_t surfaces = scene_surface_count(scene, body);
    const size_t most = solid_patches_most(scene, body);
    *p = (patches){.t = t, .bounded = true, .patch = calloc(most + 1, sizeof *p->patch)};
    if (p->patch == NULL) return error_set_memory(error);
    for (size_t k = 0; k < surfaces; ++k) {
        const surface *s = scene_surface(scene, body, k);
        double lo[3], hi[3];
        if (!exists_at(s, t)) continue;
        surface_domain(s, lo, hi);
        if (!(lo[2] <= t && t <= hi[2]))
            return error_set(
                error, IMP_ERROR_SCENE,
                "body '%.80s', surface %zu is not defined at t = %g, only from %g to %g",
                imp_scene_body_name(scene, body), k, t, lo[2], hi[2]);
        list_surface(p, s, body, k);
    }
    return p->bounded ? measure(p, error) : IMP_SUCCESS;
}

void solid_patches_free(patches *p)
{
    free(p->patch);
    *p = (patches){0};
}
