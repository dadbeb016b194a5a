/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/publish.h"
#include "plugins/patch/cell_net.h"
#include "plugins/patch/nurbs_cells.h"
#include "plugins/patch/parameters.h"
#include "plugins/patch/patch_text.h"

#include <impinge/plugin.h>

/* A NURBS surface whose control points move linearly. knots.h handles the knots and nurbs_cells.h
 * bounds the surface; this file creates and evaluates it. */

enum { DEGREE, KNOTS, KNOTS_U, KNOTS_V, POINTS, WEIGHTS, VELOCITIES };

/* A region that reaches into more cells is bounded by the stored bounds of whole cells. */
#define FEW_CELLS 16

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
    nurbs_instance *f = self;
    if (f == NULL) return;
    for (int side = 0; side < 2; ++side) knots_free(&f->side[side]);
    free(f->points);
    free(f->weights);
    free(f->velocities);
    free(f->cells);
    free(f->series);
    free(f);
}

/* A copy of all numbers; NULL: no memory. */
static double *copy_numbers(const imp_value *value)
{
    double *copy = malloc(value->count * sizeof *copy);
    if (copy != NULL) memcpy(copy, value->number, value->count * sizeof *copy);
    return copy;
}

/* Equal weights cancel: the surface is polynomial. */
static bool are_equal(const imp_value *weights)
{
    for (size_t k = 1; k < weights->count; ++k)
        if (weights->number[k] != weights->number[0]) return false;
    return true;
}

static bool copy_points(nurbs_instance *f, const imp_value *values)
{
    f->rational = !are_equal(&values[WEIGHTS]);
    f->moves = imp_is_given(&values[VELOCITIES]);
    f->points = copy_numbers(&values[POINTS]);
    if (f->rational) f->weights = copy_numbers(&values[WEIGHTS]);
    if (f->moves) f->velocities = copy_numbers(&values[VELOCITIES]);
    return f->points != NULL && (f->weights != NULL || !f->rational) &&
           (f->velocities != NULL || !f->moves);
}

/* Numbers in the series of a cell. */
static size_t cell_numbers(const nurbs_instance *f)
{
    const int degree[2] = {f->side[0].degree, f->side[1].degree};
    return patch_points(degree) * (f->moves ? 8 : 4);
}

/* Time goes with the memory of the cells. */
static imp_status check_cells(const nurbs_instance *f, imp_create_error *why)
{
    const size_t spans[2] = {f->side[0].spans, f->side[1].spans};
    const double each = (double)(sizeof(cell) + cell_numbers(f) * sizeof(double));
    const double bytes = (double)spans[0] * (double)spans[1] * each;
    if (bytes <= NURBS_CELLS_MAX) return IMP_STATUS_OK;
    return imp_reject(why, POINTS, -1,
                      "%zu x %zu spans of degree %d x %d would take %.0f MiB, must be at most %.0f "
                      "MiB: give a lower degree or fewer points, or split the surface at knots",
                      spans[0], spans[1], f->side[0].degree, f->side[1].degree,
                      ceil(bytes * 0x1p-20), NURBS_CELLS_MAX * 0x1p-20);
}

static bool allocate_cells(nurbs_instance *f)
{
    const size_t cells = f->side[0].spans * f->side[1].spans, numbers = cell_numbers(f);
    f->cells = calloc(cells, sizeof *f->cells);
    f->series = calloc(cells, numbers * sizeof *f->series);
    return f->cells != NULL && f->series != NULL;
}

static imp_status fill(nurbs_instance *f, const imp_value *values, imp_create_error *why)
{
    for (int side = 0; side < 2; ++side) {
        const knot_row row = row_of(values, side);
        if (!knots_make(&f->side[side], &row, (int)values[DEGREE].number[side]))
            return IMP_STATUS_INTERNAL;
    }
    if (!copy_points(f, values)) return IMP_STATUS_INTERNAL;
    const imp_status status = check_cells(f, why);
    if (status != IMP_STATUS_OK) return status;
    return allocate_cells(f) && nurbs_make_cells(f) ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}

static imp_status nurbs_create(const imp_value *values, void **self, imp_create_error *why)
{
    imp_status status = check(values, why);
    if (status != IMP_STATUS_OK) return status;
    nurbs_instance *f = calloc(1, sizeof *f);
    status = f != NULL ? fill(f, values, why) : IMP_STATUS_INTERNAL;
    if (status == IMP_STATUS_OK)
        *self = f;
    else
        nurbs_destroy(f);
    return status;
}

static void nurbs_domain(const void *self, double lo[3], double hi[3])
{
    const nurbs_instance *f = self;
    imp_set_domain(lo, hi, knots_lo(&f->side[0]), knots_hi(&f->side[0]), knots_lo(&f->side[1]),
                   knots_hi(&f->side[1]));
}

/* --- Points ----------------------------------------------------------------------------------- */

static bool nurbs_has(const nurbs_instance *f, const double *p)
{
    for (int side = 0; side < 2; ++side)
        if (!(p[side] >= knots_lo(&f->side[side]) && p[side] <= knots_hi(&f->side[side])))
            return false;
    return fabs(p[2]) <= PATCH_LATE;
}

/* sum_ij N_i N_j w_ij (P_ij - place, V_ij - drift), and of w_ij alone, over a cell's control
 * points: lanes as in a patch. */
static void sum_points(const nurbs_instance *f, size_t i, size_t j, const double *along_u,
                       const double *along_v, double sum[PATCH_LANES_MAX])
{
    const knots *u = &f->side[0], *v = &f->side[1];
    const patch *shape = &nurbs_cell(f, i, j)->shape;
    memset(sum, 0, PATCH_LANES_MAX * sizeof sum[0]);
    for (int r = 0; r <= u->degree; ++r)
        for (int s = 0; s <= v->degree; ++s) {
            const size_t row = u->last[i] - (size_t)(u->degree - r);
            const size_t k = row * v->count + v->last[j] - (size_t)(v->degree - s);
            const double weight = along_u[r] * along_v[s] * (f->rational ? f->weights[k] : 1);
            for (int axis = 0; axis < 3; ++axis) {
                sum[axis] += weight * (f->points[3 * k + (size_t)axis] - shape->place[axis]);
                if (f->moves)
                    sum[4 + axis] +=
                        weight * (f->velocities[3 * k + (size_t)axis] - shape->drift[axis]);
            }
            sum[PATCH_W] += weight;
        }
}

/* One point and its error.
 *
 * Lemma. As for a patch (patch_point), but the basis functions are within 6 p and 6 q units, their
 * product with the weight has 2 roundings and the net 2: (6p + 6q + 3 + (p+1)(q+1)) units of
 * `most`, which is the greatest |w (P - place)|; 2 more for its own rounding and that of the bound.
 */
static void nurbs_point(const nurbs_instance *f, const double p[3], double x[3], double error[3])
{
    const size_t i = knots_span(&f->side[0], p[0]), j = knots_span(&f->side[1], p[1]);
    const int n = f->side[0].degree, m = f->side[1].degree;
    const patch *shape = &nurbs_cell(f, i, j)->shape;
    double along_u[PATCH_SIDE_MAX], along_v[PATCH_SIDE_MAX], sum[PATCH_LANES_MAX], t = p[2];
    const double unit = (6 * (n + m) + (n + 1) * (m + 1) + 5) * ROUNDING * SLACK;
    knots_basis(&f->side[0], i, p[0], along_u);
    knots_basis(&f->side[1], j, p[1], along_v);
    sum_points(f, i, j, along_u, along_v, sum);
    const double w = f->rational ? sum[PATCH_W] : 1, twice = f->rational ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double form = sum[axis] / w, change = sum[4 + axis] / w;
        const double place = shape->place[axis] + form, way = t * (shape->drift[axis] + change);
        const double slip = shape->most[axis] / w + twice * fabs(form);
        const double slide = shape->most[4 + axis] / w + twice * fabs(change);
        x[axis] = place + way;
        error[axis] = unit * (slip + fabs(t) * slide) +
                      3 * SLACK * ROUNDING * (fabs(place) + fabs(way)) +
                      IMP_TINY / shape->weight_lo;
    }
}

static imp_status nurbs_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    double unwanted[3];
    for (size_t k = 0; k < n; ++k) {
        if (!nurbs_has(self, p + 3 * k)) return IMP_STATUS_DOMAIN;
        nurbs_point(self, p + 3 * k, x + 3 * k, error != NULL ? error + 3 * k : unwanted);
    }
    return IMP_STATUS_OK;
}

/* --- Regions ---------------------------------------------------------------------------------- */

static imp_status nurbs_include(const void *self, const imp_region *region, imp_model model[3])
{
    const nurbs_instance *f = self;
    if (!nurbs_has(f, region->lo) || !nurbs_has(f, region->hi)) {
        for (int axis = 0; axis < 3; ++axis) model[axis] = imp_unbounded(7);
        return IMP_STATUS_UNBOUNDED;
    }
    const cell_range cells = nurbs_cells_of(f, region);
    const size_t count = cell_range_count(&cells);
    if (count == 1) return cell_include(f, cells.from[0], cells.from[1], region, model);
    if (count <= FEW_CELLS) return nurbs_include_few(f, nurbs_eval, cells, region, model);
    nurbs_include_many(f, cells, region, model);
    return IMP_STATUS_OK;
}

static imp_status nurbs_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    imp_model model[3];
    imp_status status = nurbs_include(self, region, model);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        memcpy(rates->m[i], model[i].rate, sizeof rates->m[i]);
    return status;
}

static imp_status nurbs_net(const void *self, const imp_region *region, imp_net *net)
{
    const nurbs_instance *f = self;
    if (!nurbs_has(f, region->lo) || !nurbs_has(f, region->hi)) return IMP_STATUS_UNBOUNDED;
    return nurbs_cell_net(f, region, net);
}

static imp_status nurbs_write_formula(const void *self, const imp_text_sink *to)
{
    nurbs_write(self, to);
    return IMP_STATUS_OK;
}

static const imp_surface_type nurbs = {
    IMP_SURFACE_FIELDS_OF("nurbs", nurbs, nurbs, nurbs_destroy),
    .net = nurbs_net,
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
