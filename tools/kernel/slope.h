/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_KERNEL_SLOPE_H
#define TOOLS_KERNEL_SLOPE_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* Sets of real numbers between two doubles
 * ========================================
 * Each result contains what the operands' numbers give: MPFI computes it and rounds outward. lo <=
 * hi, neither is NaN, and either may be infinite. Not thread-safe. */

typedef struct range {
    double lo, hi;
} range;

#define RANGE_ALL ((range){-INFINITY, INFINITY})

static inline range range_of(double x) { return (range){x, x}; }
static inline bool range_is(range x, double value) { return x.lo == value && x.hi == value; }
static inline bool range_has_0(range x) { return !(x.lo > 0 || x.hi < 0); }
static inline range range_neg(range x) { return (range){-x.hi, -x.lo}; }

range range_both(range x, range y); /* the numbers that are in both; lo > hi: there are none */
range range_hull(range x, range y);
range range_greatest(range x, range y);
double range_middle(range x); /* of a finite range, a double near its middle */
range range_add(range x, range y);
range range_sub(range x, range y);
range range_mul(range x, range y);
range range_div(range x, range y); /* RANGE_ALL if 0 is in y */
range range_pi(void);
range range_hypot(range x, range y); /* the root of x^2 + y^2 */
range range_power(range x, range y); /* of x >= 0 */

/* A function over a box, by its slopes from the middle
 * ====================================================
 * At each point of the box the function is in v, and it is in c, its value at the middle, plus the
 * sum of s[j] o_j, where o_j is how far variable j is from its middle. Slopes exist where a
 * function has a kink, too. */

enum { SLOPE_VARIABLES = 8 };

typedef struct slope {
    unsigned on;         /* bit j: it may depend on variable j; the other s[j] are 0, not kept */
    bool is_undefined;   /* it may have no value somewhere in the box */
    const range *offset; /* of each variable, from its middle; NULL: it depends on none */
    range v, c, s[SLOPE_VARIABLES];
} slope;

static inline bool slope_has(const slope *x, int j) { return (x->on >> j & 1) != 0; }

slope slope_fixed(range value);

/* Variable j, which is in `where`; its middle is range_middle(where), its offset is offset[j]. */
slope slope_variable(int j, range where, const range *offset);

typedef slope slope_unary(const slope *x);
typedef slope slope_binary(const slope *x, const slope *y);

slope_unary slope_abs, slope_cos, slope_sin;
slope_binary slope_sum, slope_less, slope_product, slope_quotient, slope_greatest;
slope_binary slope_raised; /* to a power that is a constant; else it has no value */

#endif
