/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_POLYNOMIAL_H
#define TOOLS_PROOF_POLYNOMIAL_H

#include <impinge/surface.h>

#include "tools/proof/jet.h"

/* Returns the polynomial of a model, without its remainder, plus `cubic` s_u s_v s_t. */
jet polynomial_jet(const imp_model *g, double cubic, const jet s[3]);

#endif
