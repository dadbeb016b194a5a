/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/nurbs_surface.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_text.h"

#include <impinge/plugin.h>

/* A NURBS surface whose control points move linearly. All of its mathematics is in
 * nurbs_surface.h. */

enum { DEGREE, KNOTS, KNOTS_U, KNOTS_V, POINTS, WEIGHTS, VELOCITIES };

#define ROW_KNOTS(NAME, DOC)                                                                       \
    IMP_ROW(NAME, "1", NULL, IMP_PARAMETER_OPTIONAL, 1, 0, 0, -KNOT_FAR, KNOT_FAR, DOC)

static const imp_parameter parameters[] = {
    [DEGREE] = ROW_PATCH_DEGREE("[2,2]", "polynomial degrees [p,q] along u and v"),
    [KNOTS] = IMP_ROW("knots", "1", "[[0,0,0,1,2,2,2],[0,0,0,1,2,2,2]]", 0, 2, 2, 0, -KNOT_FAR,
                      KNOT_FAR, "knots along u and along v, two lists of one length; see knots_u"),
    [KNOTS_U] = ROW_KNOTS("knots_u", "instead of the first list of knots, of any length: n + p + 1 "
                                     "for n points along u"),
    [KNOTS_V] =
        ROW_KNOTS("knots_v", "instead of the second list of knots: m + q + 1 for m points along v"),
    [POINTS] = ROW_PATCH_POINTS("points", "length",
                                "[[0,0,0],[0,1,0],[0,2,0],[0,3,0],[1,0,0],[1,1,1],[1,2,1],[1,3,0],"
                                "[2,0,0],[2,1,1],[2,2,-1],[2,3,0],[3,0,0],[3,1,0],[3,2,0],[3,3,0]]",
                                3, 0, "control points [x,y,z]; point i,j is at index i*m+j"),
    [WEIGHTS] = ROW_PATCH_WEIGHTS("weights", "one per point; default: all 1"),
    [VELOCITIES] = ROW_PATCH_VELOCITIES,
};

/* --- Creation --------------------------------------------------------------------------------- */

static knot_row row_of(const imp_value *values, int side)
{
    const imp_value *own = &values[side ? KNOTS_V : KNOTS_U], *both = &values[KNOTS];
    if (imp_is_given(own))
        return (knot_row){own->number, own->extent[0], side ? KNOTS_V : KNOTS_U, -1};
    const size_t length = both->extent[1];
    return (knot_row){both->number + (size_t)side * length, length, KNOTS, side};
}

/* Checks that there are as many as control points, if any are given. */
static imp_status check_count(const imp_value *values, int parameter, const size_t count[2],
                              imp_create_error *why)
{
    const size_t found = values[parameter].extent[0];
    if (parameter != POINTS && !imp_is_given(&values[parameter])) return IMP_STATUS_OK;
    if (found % count[0] == 0 && found / count[0] == count[1]) return IMP_STATUS_OK;
    return imp_reject(why, parameter, -1,
                      "got %zu, but degree and knots make it %zu along u times %zu along v", found,
                      count[0], count[1]);
}

static imp_status check(const imp_value *values, imp_create_error *why)
{
    size_t count[2];
    for (int side = 0; side < 2; ++side) {
        const knot_row row = row_of(values, side);
        const int degree = (int)values[DEGREE].number[side];
        imp_status status = knots_check(&row, degree, why);
        if (status != IMP_STATUS_OK) return status;
        count[side] = row.length - (size_t)degree - 1;
    }
    imp_status status = IMP_STATUS_OK;
    for (int parameter = POINTS; parameter <= VELOCITIES && status == IMP_STATUS_OK; ++parameter)
        status = check_count(values, parameter, count, why);
    return status;
}

static void nurbs_destroy(void *self)
{
    if (self != NULL) nurbs_clear(self);
    free(self);
}

static const double *given(const imp_value *value)
{
    return imp_is_given(value) ? value->number : NULL;
}

static imp_status refuse_size(const nurbs_instance *f, double bytes, imp_create_error *why)
{
    return imp_reject(why, POINTS, -1,
                      "%zu x %zu spans of degree %d x %d would take %.0f MiB, must be at most %.0f "
                      "MiB: give a lower degree or fewer points, or split the surface at knots",
                      f->side[0].spans, f->side[1].spans, f->side[0].degree, f->side[1].degree,
                      ceil(bytes * 0x1p-20), NURBS_CELLS_MAX * 0x1p-20);
}

static nurbs_data data_of(const imp_value *values)
{
    return (nurbs_data){.degree = {(int)values[DEGREE].number[0], (int)values[DEGREE].number[1]},
                        .knots = {row_of(values, 0), row_of(values, 1)},
                        .points = values[POINTS].number,
                        .weights = given(&values[WEIGHTS]),
                        .velocities = given(&values[VELOCITIES])};
}

static imp_status nurbs_refill(void *self, const imp_value *values, imp_create_error *why)
{
    const imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    const nurbs_data data = data_of(values);
    return nurbs_renew(self, &data) ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}

static imp_status nurbs_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    const nurbs_data data = data_of(values);
    nurbs_instance *f = calloc(1, sizeof *f);
    double bytes = 0;
    if (f != NULL && nurbs_make(f, &data, &bytes)) {
        *self = f;
        return IMP_STATUS_OK;
    }
    status = bytes > NURBS_CELLS_MAX ? refuse_size(f, bytes, why) : IMP_STATUS_INTERNAL;
    nurbs_destroy(f);
    return status;
}

static imp_status nurbs_write_formula(const void *self, const imp_text_sink *to)
{
    nurbs_write(self, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type nurbs = {
    IMP_SURFACE_FIELDS_OF("nurbs", nurbs, nurbs, nurbs_destroy),
    .renew = nurbs_refill,
    .net = nurbs_net,
    .distance = nurbs_distance,
    .symmetry = nurbs_symmetry,
    .write_formula = nurbs_write_formula,
    .summary = "NURBS surface of any degree up to 20, rational or not, moving linearly",
    .equation =
        "sum_ij N_i(u) N_j(v) w_ij (points_ij + t velocities_ij) / sum_ij N_i(u) N_j(v) w_ij, "
        "N: B-splines over the knots, u in [knots_u_p, knots_u_n], v likewise",
    .source = "L. Piegl, W. Tiller, The NURBS Book",
    .example = "nurbs degree=2,1 knots_u=[0,0,0,1,2,2,2] knots_v=[0,0,1,1] "
               "points=[[0,0,0],[0,1,0],[1,0,1],[1,1,1],[2,0,1],[2,1,1],[3,0,0],[3,1,0]]",
};

PUBLISH_SURFACE(nurbs);
