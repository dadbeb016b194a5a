/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_include.h"
#include "plugins/patch/patch_net.h"
#include "plugins/patch/patch_rate.h"
#include "plugins/patch/patch_text.h"

#include <impinge/plugin.h>

/* A Bezier patch whose control points move linearly. All of its mathematics is in patch.h,
 * patch_rate.h, patch_include.h and patch_net.h. */

enum { DEGREE, POINTS, WEIGHTS, VELOCITIES };

static const imp_parameter parameters[] = {
    [DEGREE] = ROW_PATCH_DEGREE(NULL, "polynomial degrees [n, m] along u and v"),
    [POINTS] = ROW_PATCH_POINTS("points", "length", NULL, 3, 0,
                                "control points [x,y,z]; point i,j is at index i*(m+1)+j"),
    [WEIGHTS] = ROW_PATCH_WEIGHTS("weights", "one per point, for a rational patch; default: all 1"),
    [VELOCITIES] = ROW_PATCH_VELOCITIES,
};

/* One per control point, or absent. */
static imp_status check_count(const imp_value *values, int parameter, size_t points,
                              imp_create_error *why)
{
    size_t count = values[parameter].extent[0];
    const double *degree = values[DEGREE].number;
    if (!imp_is_given(&values[parameter]) || count == points) return IMP_STATUS_OK;
    return imp_reject(
        why, parameter, -1,
        "%zu given, but a patch of degree [%g,%g] has (%g+1)*(%g+1) = %zu control points", count,
        degree[0], degree[1], degree[0], degree[1], points);
}

static imp_status read(const imp_value *values, patch_data *data, imp_create_error *why)
{
    const double *degree = values[DEGREE].number;
    *data = (patch_data){.degree = {(int)degree[0], (int)degree[1]},
                         .points = values[POINTS].number,
                         .weights = imp_is_given(&values[WEIGHTS]) ? values[WEIGHTS].number : NULL,
                         .velocities =
                             imp_is_given(&values[VELOCITIES]) ? values[VELOCITIES].number : NULL};
    imp_status status = IMP_STATUS_OK;
    for (int parameter = POINTS; parameter <= VELOCITIES && status == IMP_STATUS_OK; ++parameter)
        status = check_count(values, parameter, patch_points(data->degree), why);
    return status;
}

static imp_status bezier_create(const imp_value *values, void **self, imp_create_error *why)
{
    patch_data data;
    const imp_status status = read(values, &data, why);
    if (status != IMP_STATUS_OK) return status;
    *self = patch_new(&data);
    return *self != NULL ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status bezier_renew(void *self, const imp_value *values, imp_create_error *why)
{
    patch_data data;
    const imp_status status = read(values, &data, why);
    if (status != IMP_STATUS_OK) return status;
    return patch_renew(self, &data) ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static void bezier_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, 1, 0, 1);
}

static imp_status bezier_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    return patch_eval(self, n, p, x, error);
}

static imp_status bezier_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    return patch_rate(self, region, rates);
}

static imp_status bezier_include(const void *self, const imp_region *region, imp_model model[3])
{
    return patch_include(self, region, model);
}

static imp_status bezier_net(const void *self, const imp_region *region, imp_net *net)
{
    return patch_net(self, region, net);
}

static imp_status bezier_write_formula(const void *self, const imp_text_sink *to)
{
    patch_write(self, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type bezier = {
    IMP_SURFACE_FIELDS(bezier, bezier),
    .renew = bezier_renew,
    .net = bezier_net,
    .write_formula = bezier_write_formula,
    .summary = "Bezier patch of any degree up to 20, polynomial or rational, moving linearly",
    .equation =
        "sum_ij B_i(u) B_j(v) w_ij (points_ij + t velocities_ij) / sum_ij B_i(u) B_j(v) w_ij, "
        "B_i(u) = choose(n,i) u^i (1-u)^(n-i), u and v in [0,1]",
    .source = "G. Farin, Curves and Surfaces for CAGD",
    .example = "bezier degree=1,1 points=[[0,0,0],[0,1,0],[1,0,0],[1,1,0.5]]",
};

PUBLISH_SURFACE(bezier);
