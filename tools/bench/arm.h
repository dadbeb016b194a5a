/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_ARM_H
#define TOOLS_BENCH_ARM_H

#include "tools/bench/bench.h"

/* An arm of six joints with a gripper: the pairs of its links that never touch
 * ============================================================================
 * Every joint turns all around. Which pairs of links a planner need not check is asked of such
 * arms; nobody else's data is needed for this one. */

enum { ARM_HARD = 3, ARM_DEPTHS = 3 };

/* Adds a case for each of the ARM_HARD pairs that take longest, then one for all pairs with 0, 1
 * and 2 joints between them, a scene for each pair. */
void arm_add_pairs(bench_cases *list);

#endif
