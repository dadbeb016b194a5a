/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_NURBS_CELLS_H
#define PLUGINS_PATCH_NURBS_CELLS_H

#include "plugins/patch/knots.h"
#include "plugins/patch/patch.h"
#include "plugins/patch/pieces.h"
#include "plugins/patch/round_net.h"

/* A NURBS surface as patches, one per cell
 * ========================================
 * A cell is a span of u times a span of v. Over it the surface is a Bezier patch whose control
 * points knots_extract makes; with x = (u - k_i) / (k_(i+1) - k_i), likewise y, it is a function on
 * [0, 1]^2 that patch_include bounds. Of a patch only what that needs is kept, and two more facts:
 *
 *   gauge[side][axis]       at least |df/dx| or |df/dy| all over the cell, velocities left out
 *   gauge_motion[side][axis]   the same of the velocity of f
 *
 * Three ways to bound a region: inside one cell, by its patch; across a few, by a quadratic for
 * all (pieces.h); across many, by what is known of each as a whole. */

typedef struct cell {
    patch shape; /* its net and differences are gone */
    double gauge[2][3], gauge_motion[2][3];
} cell;

/* The most that the cells of one surface may take, in bytes. */
#define NURBS_CELLS_MAX 0x1p30

typedef struct nurbs_instance {
    knots side[2];
    bool moves, rational;
    double *points, *weights,
        *velocities;        /* weights, velocities: NULL if rational, moves are not */
    cell *cells;            /* spans of v for each span of u */
    double *series;         /* of all cells */
    round_net round;        /* of a surface at rest; ROUND_NONE of one that moves */
    struct cell_data *room; /* for making cells; kept once the instance was refilled, else NULL */
} nurbs_instance;

static inline const cell *nurbs_cell(const nurbs_instance *f, size_t i, size_t j)
{
    return &f->cells[i * f->side[1].spans + j];
}

/* Numbers in the series of a cell. */
size_t nurbs_cell_numbers(const nurbs_instance *f);

/* Makes all cells in memory that is allocated already. False: no temporary memory. */
bool nurbs_make_cells(nurbs_instance *f);

/* Likewise, and keeps the temporary memory for the next time. */
bool nurbs_renew_cells(nurbs_instance *f);
void nurbs_free_room(nurbs_instance *f);

#define CELL_SLIP 0x1p-51 /* more than (u - k) / h is off by: three roundings, |x| <= 1 */

/* A region of u or v as one of x or y, which surely holds it; returns a bound of |x' - x| where x'
 * = c' + d' s stands for x = (c + d s - k) / h. (More than rounding only where u is much greater
 * than h: its own resolution is coarse there.) */
double cell_localize(const knots *k, size_t span, const imp_region *region, int side,
                     imp_region *local);

/* Where both x' and x are in the cell, f differs by at most the gauge times their distance: at
 * least that, in one coordinate, for |t| <= late. */
double cell_slip(const cell *c, int axis, double late, const double shift[2]);

/* Implements imp_surface_type.include for a region inside cell i, j. */
imp_status cell_include(const nurbs_instance *f, size_t i, size_t j, const imp_region *region,
                        imp_model model[3]);

/* The cells that a region reaches into. */
typedef struct cell_range {
    size_t from[2], to[2];
} cell_range;

/* The cells that a region of the domain reaches into. */
cell_range nurbs_cells_of(const nurbs_instance *f, const imp_region *region);

static inline size_t cell_range_count(const cell_range *r)
{
    return (r->to[0] - r->from[0] + 1) * (r->to[1] - r->from[1] + 1);
}

/* A few cells: pieces of one quadratic, which `eval` at points of the surface gives. */
imp_status nurbs_include_few(const nurbs_instance *f, pieces_eval *eval, cell_range cells,
                             const imp_region *region, imp_model model[3]);

/* Many cells: their hull. */
void nurbs_include_many(const nurbs_instance *f, cell_range cells, const imp_region *region,
                        imp_model model[3]);

#endif
