/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_STATED_FORMULA_H
#define TOOLS_CHECK_STATED_FORMULA_H

#include <impinge/impinge.h>

#include "tools/proof/formula.h"

/* The formula of a surface or map, if it is stated
 * ================================================
 * It is stated by the user, "X; Y; Z", or by the surface itself: if a type has texts as parameters
 * x, y and z, these are its formula. This code does not name a type.
 *
 * Constants in it are the numbers among the stage's parameters, by their names; those of a list
 * with their place behind the name, as in center0; and those of a table by their own names. */

/* NULL: `fault` says what is wrong with it, or is empty if there is none. The caller frees it. */
formula *stated_formula(const imp_registry *registry, const imp_type_info *type, const char *stage,
                        const char *given, char *fault, size_t size);

/* The constants of a stage, for texts that its type states (imp_surface_type.formula): parts are
 * read as by formula_read_part. NULL: no memory. The caller frees the scope and the formulas. */
typedef struct stated_scope stated_scope;
stated_scope *stated_scope_new(const imp_registry *registry, const imp_type_info *type,
                               const char *stage);
formula *stated_scope_read(const stated_scope *scope, const char *text,
                           formula_range range[FORMULA_VARIABLES], char *fault, size_t size);
void stated_scope_free(stated_scope *scope);

/* Reads the domain that was stated: "LO,HI; LO,HI" for u and v, and perhaps "; LO,HI" for t; for a
 * map, t alone. Ends are formulas without variables: "0,2*pi; -pi/2,pi/2". */
typedef struct said_domain {
    int count;
    ld_interval lo[3], hi[3];
} said_domain;
bool said_domain_read(said_domain *d, const imp_registry *registry, const imp_type_info *type,
                      const char *stage, const char *given, char *fault, size_t size);

#endif
