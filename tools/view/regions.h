/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_REGIONS_H
#define TOOLS_VIEW_REGIONS_H

#include "tools/view/film.h"

/* When the search proved the cells of meshes clear
 * ================================================
 * The search runs once more, in steps. A cell is proved clear once no pair of regions that is left
 * to search covers it before the answer's time. What is kept is how many pairs had been tested by
 * then, as seen at the end of a step. */

typedef struct regions {
    double **pairs; /* [track][cell of its mesh] */
    double *whole;  /* [track]: the last number of pairs at which all cells were noted */
    size_t count;
    double total; /* pairs tested in all */
} regions;

/* Free in any case. */
imp_code regions_measure(const subject *what, const film *f, regions *r, imp_error *error);
void regions_free(regions *r);

#endif
