/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_TURNED_SURFACE_H
#define PLUGINS_EXPRESSION_TURNED_SURFACE_H

#include "plugins/common/round_distance.h"
#include "plugins/expression/turned_form.h"

#include <impinge/surface.h>

/* Distances and symmetries of formulas that are surfaces of revolution
 * ==================================================================== */

typedef struct turned_surface {
    turned_form form;
    const expression_program *section; /* R, Z and phi in u and v */
    round_profile round;
    uint32_t is_closed; /* as of imp_symmetry */
} turned_surface;

/* Fills what follows from form and section, for u and v from lo to hi. */
void turned_surface_begin(turned_surface *s, const double lo[2], const double hi[2]);

/* Whether there is a distance. */
static inline bool turned_surface_is_round(const turned_surface *s)
{
    return s->round.kind != ROUND_NONE;
}

imp_model turned_surface_gap(const turned_surface *s, const imp_model x[3]);
imp_status turned_surface_symmetry(const turned_surface *s, imp_symmetry *symmetry);

#endif
