/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_PATCH_PATCH_TEXT_H
#define PLUGINS_PATCH_PATCH_TEXT_H

#include "plugins/patch/nurbs_cells.h"
#include "plugins/patch/patch.h"

#include <impinge/formula_text.h>

/* Patches, curves and NURBS surfaces as formulas
 * ==============================================
 * Basis functions are definitions, and each coordinate is the sum over control points, as they were
 * given: of a patch the formula of patch.h without `place` and `drift`. */

/* Defines the Bernstein polynomials of degree n in a variable as letter0, letter1, ... */
void bernstein_define(const imp_text_sink *to, char letter, int n, char variable);

/* Prints the letter and the number, and what follows. */
void patch_add_name(const imp_text_sink *to, char letter, size_t number, const char *after);

/* Prints the whole formula of a patch over [0, 1]^2. */
void patch_write(const patch *f, const imp_text_sink *to);

/* Prints the whole formula of a triangle (triangle.h), which triangle_new made. */
void triangle_write(const patch *f, const imp_text_sink *to);

/* Prints definitions of the coordinates of a curve (curve.h) in a variable, "c0 = ...; c1 = ...; c2
 * = ...; " for the letter c. Names that begin with the letter are used. */
void curve_write(const patch *f, char letter, char variable, const imp_text_sink *to);

/* Prints the whole formula of a NURBS surface: a part for each cell. */
void nurbs_write(const nurbs_instance *f, const imp_text_sink *to);

#endif
