/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_FORMULA_TEXT_H
#define CORE_SURFACE_FORMULA_TEXT_H

#include "core/surface/surface.h"

/* The formula of an instance, closed
 * ==================================
 * What a type says of an instance (imp_surface_type.formula, write_formula), with the numbers that
 * it names bound: each part begins with definitions of the parameters that it uses. The language is
 * not read here, but for names. */

/* Tells the formula of what the surface is composed of, by k as in surface_origin; for a piece, its
 * own. *text becomes NULL where there is none; the caller frees it by free(). IMP_STATUS_INTERNAL:
 * no memory, or the callback says so; another status is a breach, told by surface_status_told. */
imp_status surface_formula(const surface *s, size_t k, char **text);

#endif
