/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/nurbs_surface.h"

#include "plugins/patch/cell_net.h"

#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* A region that reaches into more cells is bounded by the stored bounds of whole cells. */
#define FEW_CELLS 16

/* --- Creation --------------------------------------------------------------------------------- */

/* A copy of all numbers; NULL: no memory. */
static double *copy_numbers(const double *number, size_t count)
{
    double *copy = malloc(count * sizeof *copy);
    if (copy != NULL) memcpy(copy, number, count * sizeof *copy);
    return copy;
}

/* Equal weights cancel: the surface is polynomial. */
static bool are_equal(const double *weights, size_t count)
{
    for (size_t k = 1; k < count; ++k)
        if (weights[k] != weights[0]) return false;
    return true;
}

static bool copy_points(nurbs_instance *f, const nurbs_data *data)
{
    const size_t count = f->side[0].count * f->side[1].count;
    f->rational = data->weights != NULL && !are_equal(data->weights, count);
    f->moves = data->velocities != NULL;
    f->points = copy_numbers(data->points, 3 * count);
    if (f->rational) f->weights = copy_numbers(data->weights, count);
    if (f->moves) f->velocities = copy_numbers(data->velocities, 3 * count);
    return f->points != NULL && (f->weights != NULL || !f->rational) &&
           (f->velocities != NULL || !f->moves);
}

static bool allocate_cells(nurbs_instance *f)
{
    const size_t cells = f->side[0].spans * f->side[1].spans, numbers = nurbs_cell_numbers(f);
    f->cells = calloc(cells, sizeof *f->cells);
    f->series = calloc(cells, numbers * sizeof *f->series);
    return f->cells != NULL && f->series != NULL;
}

/* Time goes with the memory of the cells. */
static double bytes_of(const nurbs_instance *f)
{
    const double each = (double)(sizeof(cell) + nurbs_cell_numbers(f) * sizeof(double));
    return (double)f->side[0].spans * (double)f->side[1].spans * each;
}

static void find_round(nurbs_instance *f)
{
    memset(&f->round, 0, sizeof f->round);
    if (!f->moves) f->round = round_net_of(f->side, f->points, f->weights);
}

bool nurbs_make(nurbs_instance *f, const nurbs_data *data, double *bytes)
{
    memset(f, 0, sizeof *f);
    *bytes = 0;
    for (int side = 0; side < 2; ++side)
        if (!knots_make(&f->side[side], &data->knots[side], data->degree[side])) return false;
    if (!copy_points(f, data)) return false;
    *bytes = bytes_of(f);
    if (!(*bytes <= NURBS_CELLS_MAX)) return false;
    find_round(f);
    return allocate_cells(f) && nurbs_make_cells(f);
}

bool nurbs_renew(nurbs_instance *f, const nurbs_data *data)
{
    for (int side = 0; side < 2; ++side)
        if (!knots_renew(&f->side[side], &data->knots[side], data->degree[side])) return false;
    const size_t count = f->side[0].count * f->side[1].count;
    const bool rational = data->weights != NULL && !are_equal(data->weights, count);
    if (rational != f->rational || (data->velocities != NULL) != f->moves) return false;
    memcpy(f->points, data->points, 3 * count * sizeof *f->points);
    if (f->rational) memcpy(f->weights, data->weights, count * sizeof *f->weights);
    if (f->moves) memcpy(f->velocities, data->velocities, 3 * count * sizeof *f->velocities);
    find_round(f);
    return nurbs_renew_cells(f);
}

void nurbs_clear(nurbs_instance *f)
{
    nurbs_free_room(f);
    for (int side = 0; side < 2; ++side) knots_free(&f->side[side]);
    free(f->points);
    free(f->weights);
    free(f->velocities);
    free(f->cells);
    free(f->series);
}

void nurbs_domain(const void *self, double lo[3], double hi[3])
{
    const nurbs_instance *f = self;
    for (int side = 0; side < 2; ++side) {
        lo[side] = knots_lo(&f->side[side]);
        hi[side] = knots_hi(&f->side[side]);
    }
    lo[2] = -INFINITY, hi[2] = INFINITY;
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

imp_status nurbs_eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    double unwanted[3];
    for (size_t k = 0; k < n; ++k) {
        if (!nurbs_has(self, p + 3 * k)) return IMP_STATUS_DOMAIN;
        nurbs_point(self, p + 3 * k, x + 3 * k, error != NULL ? error + 3 * k : unwanted);
    }
    return IMP_STATUS_OK;
}

/* --- Regions ---------------------------------------------------------------------------------- */

imp_status nurbs_include(const void *self, const imp_region *region, imp_model model[3])
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

imp_status nurbs_rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    imp_model model[3];
    imp_status status = nurbs_include(self, region, model);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        memcpy(rates->m[i], model[i].rate, sizeof rates->m[i]);
    return status;
}

imp_status nurbs_net(const void *self, const imp_region *region, imp_net *net)
{
    const nurbs_instance *f = self;
    if (!nurbs_has(f, region->lo) || !nurbs_has(f, region->hi)) return IMP_STATUS_UNBOUNDED;
    return nurbs_cell_net(f, region, net);
}

/* --- Distances -------------------------------------------------------------------------------- */

static imp_model nurbs_gap(const void *self, imp_model x, imp_model y, imp_model z, imp_model t)
{
    (void)t;
    return round_net_distance(&((const nurbs_instance *)self)->round, x, y, z);
}
IMP_DISTANCE_FORMULA(nurbs_gap)

imp_status nurbs_distance(const void *self, const imp_model point[4], imp_model *distance)
{
    const nurbs_instance *f = self;
    if (f->round.profile.kind == ROUND_NONE) return IMP_STATUS_UNBOUNDED;
    return nurbs_gap_distance(self, point, distance);
}

imp_status nurbs_symmetry(const void *self, imp_symmetry *symmetry)
{
    return round_net_symmetry(&((const nurbs_instance *)self)->round, symmetry);
}
