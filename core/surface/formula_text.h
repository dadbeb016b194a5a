/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_FORMULA_TEXT_H
#define CORE_SURFACE_FORMULA_TEXT_H

#include "core/surface/surface.h"

/* The formula of an instance, closed
 * ==================================
 * The formula that a type prints for an instance (imp_surface_type.formula, write_formula), with
 * its parameters bound: each part begins with definitions of the parameters that it uses. Only
 * names are parsed here. */

/* Returns in *text the formula of instance k of the surface (surface_origin); for a piece, its own.
 * It is NULL if there is none; the caller frees it by free(). IMP_STATUS_INTERNAL: no memory, or
 * the callback returned it; another status is a breach of the ABI (surface_status_message). */
imp_status surface_formula(const surface *s, size_t k, char **text);

/* Like surface_formula, of an instance that follows a clock (its `inner`): its t is the clock's
 * value. */
imp_status surface_own_formula(const surface *s, size_t k, char **text);

#endif
