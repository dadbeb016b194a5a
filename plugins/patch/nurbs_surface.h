/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_NURBS_SURFACE_H
#define PLUGINS_PATCH_NURBS_SURFACE_H

#include "plugins/patch/nurbs_cells.h"

/* NURBS surfaces, for all types that consist of them
 * ==================================================
 * Control points move linearly. knots.h handles the knots and nurbs_cells.h bounds the surface;
 * this file creates and evaluates it. */

/* Checked rows of knots, and control points; point i, j is at index i * m + j. */
typedef struct nurbs_data {
    int degree[2];
    knot_row knots[2];
    const double *points;     /* 3 for each */
    const double *weights;    /* one for each; NULL: polynomial */
    const double *velocities; /* 3 for each; NULL: at rest */
} nurbs_data;

/* Makes a surface in *f, of copies of the data. False: no memory, or, if *bytes is more than
 * NURBS_CELLS_MAX then, too much. nurbs_clear it all the same. */
bool nurbs_make(nurbs_instance *f, const nurbs_data *data, double *bytes);
void nurbs_clear(nurbs_instance *f);

/* Makes the surface of other data in *f, whose memory it uses again. False: there is no room for
 * these, or no temporary memory; then only nurbs_clear is left. */
bool nurbs_renew(nurbs_instance *f, const nurbs_data *data);

/* Implement the callbacks of imp_surface_type; `self` is a nurbs_instance. */
void nurbs_domain(const void *self, double lo[3], double hi[3]);
imp_status nurbs_eval(const void *self, size_t n, const double *p, double *x, double *error);
imp_status nurbs_include(const void *self, const imp_region *region, imp_model model[3]);
imp_status nurbs_rate(const void *self, const imp_region *region, imp_rate_matrix *rates);
imp_status nurbs_net(const void *self, const imp_region *region, imp_net *net);
imp_status nurbs_distance(const void *self, const imp_model point[4], imp_model *distance);
imp_status nurbs_symmetry(const void *self, imp_symmetry *symmetry);

#endif
