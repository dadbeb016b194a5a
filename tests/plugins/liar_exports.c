/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* A second symbol, for all the world to collide with. */
IMP_EXPORT int liar_helper(void);
int liar_helper(void) { return 1; }
LIAR_INCLUDE("liar_exports", wavy_formula_include);
