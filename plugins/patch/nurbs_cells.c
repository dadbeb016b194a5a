/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/patch/nurbs_cells.h"

#include "plugins/patch/patch_include.h"
#include "plugins/patch/patch_series.h"

#include <impinge/formula.h>
#include <stdlib.h>
#include <string.h>

/* --- Making cells ----------------------------------------------------------------------------- */

/* Memory for one cell's control points, in the order of a patch. */
typedef struct cell_data {
    double points[3 * PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    double velocities[3 * PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    double weights[PATCH_SIDE_MAX * PATCH_SIDE_MAX];
    double along_u[PATCH_SIDE_MAX * PATCH_SIDE_MAX]; /* knots_extract of the span of u */
    double *along_v; /* likewise, of all spans of v, which all rows of cells need */
    patch_data data;
    patch *patch;
    double *work;
} cell_data;

/* How many numbers knots_extract makes. */
static size_t cell_matrix_size(const knots *k)
{
    return (size_t)(k->degree + 1) * (size_t)(k->degree + 1);
}

size_t nurbs_cell_numbers(const nurbs_instance *f)
{
    const int degree[2] = {f->side[0].degree, f->side[1].degree};
    return patch_points(degree) * (f->moves ? 8 : 4);
}

/* The control points that matter in cell i, j: neighbours in both directions. */
static void cell_gather(const nurbs_instance *f, size_t i, size_t j, cell_data *to)
{
    const knots *u = &f->side[0], *v = &f->side[1];
    size_t count = 0;
    for (size_t r = u->last[i] - (size_t)u->degree; r <= u->last[i]; ++r)
        for (size_t s = v->last[j] - (size_t)v->degree; s <= v->last[j]; ++s, ++count) {
            const size_t k = r * v->count + s;
            memcpy(to->points + 3 * count, f->points + 3 * k, 3 * sizeof(double));
            if (f->moves)
                memcpy(to->velocities + 3 * count, f->velocities + 3 * k, 3 * sizeof(double));
            if (f->rational) to->weights[count] = f->weights[k];
        }
}

/* From the spline's control points to the patch's, by the matrices of the spans. Lemma (units): a
 * number of the net has 2 roundings to begin with, 5 p and 5 q in the matrices' entries, and passes
 * a product and at most p + 1 or q + 1 sums twice; all relative to `most`, as each row of a matrix
 * adds up to 1. */
static void cell_set_net(patch *f, const cell_data *from, const double *along_v)
{
    const int p = f->degree[0], q = f->degree[1], row = (q + 1) * f->lanes;
    patch_multiply(p + 1, from->along_u, f->net, from->work, row);
    for (int i = 0; i <= p; ++i)
        patch_multiply(q + 1, along_v, from->work + i * row, f->net + i * row, f->lanes);
    f->units = 6 * (p + q) + 6;
}

/* Lemma. With g = X / W, |g| <= place_radius because it is in the hull of the control points less
 * their middle: |g'| = |X' - g W'| / W. */
static void cell_set_gauges(cell *c)
{
    const patch *f = &c->shape;
    for (int side = 0; side < 2; ++side)
        for (int axis = 0; axis < 3; ++axis) {
            const double *slope = f->slope[side], turn = slope[PATCH_W];
            c->gauge[side][axis] =
                (slope[axis] + f->place_radius[axis] * turn) / f->weight_lo * SLACK;
            c->gauge_motion[side][axis] =
                (slope[4 + axis] + f->drift_radius[axis] * turn) / f->weight_lo * SLACK;
        }
}

static void cell_make(const nurbs_instance *f, size_t i, size_t j, cell_data *temporary,
                      double *series)
{
    cell *c = &f->cells[i * f->side[1].spans + j];
    patch *shape = temporary->patch;
    const size_t numbers = patch_points(shape->degree) * (size_t)shape->lanes;
    cell_gather(f, i, j, temporary);
    patch_set_net(shape, &temporary->data);
    cell_set_net(shape, temporary, temporary->along_v + j * cell_matrix_size(&f->side[1]));
    patch_set_differences(shape, 0);
    patch_set_differences(shape, 1);
    patch_set_series(shape, temporary->work);
    c->shape = *shape;
    c->shape.net = c->shape.difference[0] = c->shape.difference[1] = NULL;
    c->shape.series = series;
    memcpy(series, shape->series, numbers * sizeof *series);
    cell_set_gauges(c);
}

void nurbs_free_room(nurbs_instance *f)
{
    if (f->room == NULL) return;
    free(f->room->along_v);
    free(f->room->work);
    free(f->room->patch);
    free(f->room);
    f->room = NULL;
}

/* False: no memory, and there is no room. */
static bool make_room(nurbs_instance *f)
{
    cell_data *made = calloc(1, sizeof *made);
    if (made == NULL) return false;
    made->data = (patch_data){.degree = {f->side[0].degree, f->side[1].degree},
                              .points = made->points,
                              .velocities = f->moves ? made->velocities : NULL,
                              .weights = f->rational ? made->weights : NULL};
    made->patch = patch_allocate(&made->data);
    made->work = malloc(nurbs_cell_numbers(f) * sizeof(double));
    made->along_v = malloc(f->side[1].spans * cell_matrix_size(&f->side[1]) * sizeof(double));
    f->room = made;
    if (made->patch != NULL && made->work != NULL && made->along_v != NULL) return true;
    nurbs_free_room(f);
    return false;
}

bool nurbs_renew_cells(nurbs_instance *f)
{
    if (f->room == NULL && !make_room(f)) return false;
    const knots *v = &f->side[1];
    double *series = f->series;
    for (size_t j = 0; j < v->spans; ++j)
        knots_extract(v, j, f->room->along_v + j * cell_matrix_size(v));
    for (size_t i = 0; i < f->side[0].spans; ++i) {
        knots_extract(&f->side[0], i, f->room->along_u);
        for (size_t j = 0; j < v->spans; ++j, series += nurbs_cell_numbers(f))
            cell_make(f, i, j, f->room, series);
    }
    return true;
}

bool nurbs_make_cells(nurbs_instance *f)
{
    const bool made = nurbs_renew_cells(f);
    nurbs_free_room(f);
    return made;
}

/* --- Inside one cell -------------------------------------------------------------------------- */

double cell_localize(const knots *k, size_t span, const imp_region *region, int side,
                     imp_region *local)
{
    const double from = k->ends[span], h = k->ends[span + 1] - from;
    const double lo = (region->lo[side] - from) / h - CELL_SLIP;
    const double hi = (region->hi[side] - from) / h + CELL_SLIP;
    const imp_interval x = {imp_larger(lo, 0), imp_smaller(hi, 1)};
    const double c = imp_interval_mid(x), d = imp_interval_radius_upper(x, c);
    local->lo[side] = x.lo, local->hi[side] = x.hi;
    local->c[side] = c, local->d[side] = d;
    return fabs((region->c[side] - from) / h - c) + fabs(region->d[side] / h - d) + 2 * CELL_SLIP;
}

double cell_slip(const cell *c, int axis, double late, const double shift[2])
{
    double slip = 0;
    for (int side = 0; side < 2; ++side)
        slip += shift[side] * (c->gauge[side][axis] + late * c->gauge_motion[side][axis]);
    return slip * SLACK + IMP_TINY;
}

/* From a model over x and y to one over u and v. */
static void cell_globalize(const cell *c, int axis, double late, const double h[2],
                           const double shift[2], imp_model *g)
{
    const double slip = cell_slip(c, axis, late, shift);
    for (int side = 0; side < 2; ++side) g->rate[side] = g->rate[side] / h[side] * SLACK;
    g->e = imp_sum_up(g->e + slip);
    g->lo = imp_sum_down(g->lo - slip);
    g->hi = imp_sum_up(g->hi + slip);
}

imp_status cell_include(const nurbs_instance *f, size_t i, size_t j, const imp_region *region,
                        imp_model model[3])
{
    const cell *c = nurbs_cell(f, i, j);
    const double *u = f->side[0].ends + i, *v = f->side[1].ends + j;
    const double late = fabs(region->c[2]) + region->d[2], h[2] = {u[1] - u[0], v[1] - v[0]};
    imp_region local = *region;
    const double shift[2] = {cell_localize(&f->side[0], i, region, 0, &local),
                             cell_localize(&f->side[1], j, region, 1, &local)};
    imp_status status = patch_include(&c->shape, &local, model);
    for (int axis = 0; axis < 3 && status == IMP_STATUS_OK; ++axis)
        cell_globalize(c, axis, late, h, shift, &model[axis]);
    return status;
}

/* --- Across cells ----------------------------------------------------------------------------- */

cell_range nurbs_cells_of(const nurbs_instance *f, const imp_region *region)
{
    cell_range r;
    for (int side = 0; side < 2; ++side) {
        r.from[side] = knots_span(&f->side[side], region->lo[side]);
        r.to[side] = knots_last_span(&f->side[side], region->hi[side], r.from[side]);
    }
    return r;
}

/* The part of a region inside cell i, j. */
static imp_region cell_part(const nurbs_instance *f, size_t i, size_t j, const imp_region *region)
{
    const size_t at[2] = {i, j};
    double lo[3], hi[3];
    for (int side = 0; side < 2; ++side) {
        const double *ends = f->side[side].ends + at[side];
        lo[side] = imp_larger(region->lo[side], ends[0]);
        hi[side] = imp_smaller(region->hi[side], ends[1]);
    }
    lo[2] = region->lo[2], hi[2] = region->hi[2];
    return imp_region_between(lo, hi);
}

/* A few cells: pieces of one quadratic. */
imp_status nurbs_include_few(const nurbs_instance *f, pieces_eval *eval, cell_range cells,
                             const imp_region *region, imp_model model[3])
{
    imp_status status = pieces_sample(eval, f, region, model);
    for (int axis = 0; axis < 3; ++axis) pieces_begin(&model[axis]);
    for (size_t i = cells.from[0]; i <= cells.to[0]; ++i)
        for (size_t j = cells.from[1]; j <= cells.to[1] && status == IMP_STATUS_OK; ++j) {
            imp_model g[3];
            const imp_region part = cell_part(f, i, j, region);
            const pieces_shift shift = pieces_shift_of(region, &part);
            status = cell_include(f, i, j, &part, g);
            for (int axis = 0; axis < 3 && status == IMP_STATUS_OK; ++axis)
                pieces_add(&model[axis], &g[axis], &shift);
        }
    for (int axis = 0; axis < 3 && status == IMP_STATUS_OK; ++axis)
        model[axis] = pieces_end(&model[axis]);
    return status;
}

/* What many cells have in common, per coordinate. */
typedef struct cell_hull {
    imp_interval still, motion; /* of f at time 0, and of its velocity */
    double rate[2];             /* per unit of u and v */
} cell_hull;

static void cell_hull_add(cell_hull *hull, const nurbs_instance *f, size_t i, size_t j, int axis,
                          double late)
{
    const cell *c = nurbs_cell(f, i, j);
    const patch *g = &c->shape;
    const size_t at[2] = {i, j};
    const double r = g->place_radius[axis], s = g->drift_radius[axis];
    hull->still.lo = imp_smaller(hull->still.lo, imp_sum_down(g->place[axis] - r));
    hull->still.hi = imp_larger(hull->still.hi, imp_sum_up(g->place[axis] + r));
    hull->motion.lo = imp_smaller(hull->motion.lo, imp_sum_down(g->drift[axis] - s));
    hull->motion.hi = imp_larger(hull->motion.hi, imp_sum_up(g->drift[axis] + s));
    for (int side = 0; side < 2; ++side) {
        const double *ends = f->side[side].ends + at[side];
        const double gauge = c->gauge[side][axis] + late * c->gauge_motion[side][axis];
        hull->rate[side] = imp_larger(hull->rate[side], gauge / (ends[1] - ends[0]));
    }
}

/* f is in still + t motion: a motion of the middle, and a remainder. */
static imp_model cell_hull_model(const cell_hull *hull, const imp_region *region, bool moves)
{
    const imp_model still = imp_between(hull->still.lo, hull->still.hi);
    imp_model g = still;
    if (moves)
        g = imp_add(still,
                    imp_mul(imp_between(hull->motion.lo, hull->motion.hi), imp_param(region, 2)));
    g.depends = moves ? 7 : 3;
    g.rate[0] = hull->rate[0] * SLACK;
    g.rate[1] = hull->rate[1] * SLACK;
    return g;
}

/* Many cells. */
void nurbs_include_many(const nurbs_instance *f, cell_range cells, const imp_region *region,
                        imp_model model[3])
{
    const double late = fabs(region->c[2]) + region->d[2];
    for (int axis = 0; axis < 3; ++axis) {
        cell_hull hull = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}, {0, 0}};
        for (size_t i = cells.from[0]; i <= cells.to[0]; ++i)
            for (size_t j = cells.from[1]; j <= cells.to[1]; ++j)
                cell_hull_add(&hull, f, i, j, axis, late);
        model[axis] = cell_hull_model(&hull, region, f->moves);
    }
}
