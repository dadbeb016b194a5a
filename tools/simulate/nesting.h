/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_NESTING_H
#define TOOLS_SIMULATE_NESTING_H

#include "tools/simulate/shells.h"

/* Which shells are walls of cavities: by shell 1, or -1 inside an odd number of others. One shell
 * is inside another if the latter winds around its points, which is decided by the solid angle of a
 * polyhedron: shells that nearly touch may be misjudged. */
shape_verdict nesting_find(const patches *p, const shells *s, double *sign, imp_error *why);

#endif
