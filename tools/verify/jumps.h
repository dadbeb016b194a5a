/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_JUMPS_H
#define TOOLS_VERIFY_JUMPS_H

#include "tools/verify/enclose.h"

/* Values at which both surfaces of a pair may jump
 * ================================================
 * Where parts of formulas meet at a value of a clock, both count there: all stages of a surface,
 * its shape and its maps, take the parts before it, or all those after it. Cells end at that value,
 * so that a part of A that ends there and one of B that begins there are in no cell together: such
 * values are proved by themselves. If one surface alone has parts that meet there, no pair of
 * points is left out. Where the claim begins or ends, a part on the other side counts. */

typedef struct jumps {
    double *at[CLOCKS_MAX]; /* of each clock, in order */
    size_t count[CLOCKS_MAX];
} jumps;

/* Finds the values for a pair, with the maps of `side`. To be freed; false: memory ran out. */
bool jumps_find(const place side[2], jumps *found);
void jumps_free(jumps *j);

bool jumps_has(const jumps *j, size_t clock, double at);

#endif
