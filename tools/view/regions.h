/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_REGIONS_H
#define TOOLS_VIEW_REGIONS_H

#include "tools/view/film.h"

/* When the search proved the cells of meshes clear
 * ================================================
 * The search runs once more, in steps. A cell is proved clear once no pair of regions on the heap
 * covers it before the answer's time. For each cell the number of pairs tested by then is kept, to
 * the end of a step. */

typedef struct regions {
    double **pairs; /* [track][cell of its mesh] */
    double *whole;  /* [track]: the last number of pairs at which all cells were noted */
    size_t count;
    double total; /* pairs tested in all */
} regions;

/* Runs the search and fills *regions; free it in any case. */
imp_code regions_measure(const subject *what, const film *f, regions *r, imp_error *error);
void regions_free(regions *r);

#endif
