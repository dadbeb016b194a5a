/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_OWN_FORMULA_H
#define TOOLS_CHECK_OWN_FORMULA_H

#include "tools/check/stated_formula.h"
#include "tools/check/subject.h"

/* The formula that a type states itself
 * =====================================
 * What imp_surface_type.formula or write_formula say of an instance, or of a piece, read by the
 * reader of tools/proof. The numbers of its parameters are taken from the stage, not from the host,
 * which binds them in a way of its own (imp_piece_formula). */

typedef struct own_part {
    formula *f;
    formula_range range[FORMULA_VARIABLES]; /* of u, v, t or x, y, z, t */
} own_part;

typedef struct own_formula {
    own_part *parts;
    size_t count, capacity;
} own_formula;

/* Reads what the instance's type states. count 0: it states nothing, and
 * `fault` is empty; else it says why the text cannot be used. The caller frees it. */
own_formula own_formula_read(const imp_registry *registry, const imp_type_info *type,
                             const char *stage, const imp_instance *instance, check_answer *answer,
                             char *fault, size_t size);
void own_formula_free(own_formula *f);

/* By how much ends of a domain may be off: they are computed in double precision. `size`: of the
 * variable's numbers. */
long double own_end_slack(double size);

/* Returns whether the range holds x, ends included; a little beyond them where the ends of the
 * domain are rounded, for a variable whose numbers are of that size. */
bool own_range_holds(const formula_range *range, double x, double size);

/* Returns the box of a part, in the domain of the subject. */
box own_part_box(const own_part *part, const subject *s);

#endif
