/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_EXPRESSION_COIL_SURFACE_H
#define PLUGINS_EXPRESSION_COIL_SURFACE_H

#include "plugins/common/coil.h"
#include "plugins/expression/coil_form.h"

#include <impinge/surface.h>

/* Distances and symmetries of formulas that are coils
 * =================================================== */

typedef struct coil_surface {
    coil_form form;
    const expression_program *radius; /* R in u and v, three times */
    coil base;                        /* but for self */
    near_constant inverse;            /* of the greater of w's coefficients */
    double slack;                     /* room of a phase for whole turns */
    bool is_left;                     /* the screw is left-handed */
    bool is_closed;                   /* it goes all around, and ends in planes */
    double lead, lead_off;            /* of a turn, rounded, and room for that; length */
} coil_surface;

/* Fills what follows from form and radius, for u and v from lo to hi. False: no distance is
 * known. */
bool coil_surface_begin(coil_surface *s, const double lo[2], const double hi[2]);

imp_model coil_surface_gap(const coil_surface *s, const imp_model x[3]);
imp_status coil_surface_symmetry(const coil_surface *s, imp_symmetry *symmetry);

#endif
