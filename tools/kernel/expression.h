/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_KERNEL_EXPRESSION_H
#define TOOLS_KERNEL_EXPRESSION_H

#include "tools/kernel/slope.h"

/* A formula: three expressions in up to four variables
 * ====================================================
 *   part     = { item ";" } sum ";" sum ";" sum
 *   item     = name "=" sum | variable "in" "[" end "," end "]"     end = sum | "inf" | "-inf"
 *   sum      = product { ("+" | "-") product }
 *   product  = signed { ("*" | "/") signed }
 *   signed   = { "+" | "-" } operand [ "^" signed ]
 *   operand  = number | name | name "(" sum { "," sum } ")" | "(" sum ")"
 *
 * Numbers stand for the nearest double; names are variables, those defined before, or pi. */

enum { EXPRESSION_VARIABLES = 4 };

typedef struct expression expression;

/* Reads one part; *text becomes what follows its '|', or NULL. Writes the ranges of the variables,
 * whose letters are `variables`, outward; RANGE_ALL: none is said. NULL: *why tells. */
expression *expression_read(const char **text, const char *variables,
                            range said[EXPRESSION_VARIABLES], const char **why);

/* Computes the three from slopes of the variables, which `out` may be. Not thread-safe. */
void expression_compute(const expression *e, const slope *variables, slope out[3]);

#endif
