/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_FORMULAS_H
#define TOOLS_CHECK_FORMULAS_H

#include <impinge/impinge.h>

#include "tools/check/answer.h"

/* Whether a type is what its formula says
 * =======================================
 * The formula that the type states (own_formula.h) is computed by the interval arithmetic of
 * tools/proof, and compared with eval: of the stage, of instances whose numbers are near its own
 * and chosen at random, and of their pieces. Every point of the domain must be in a part; in every
 * part that holds it, no value may surely be farther from eval's than the error that eval admits.
 * The ranges of the parts must be the domain. Skips types that state none. */
void formula_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                   check_answer *answer);

#endif
