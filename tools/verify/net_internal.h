/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_NET_INTERNAL_H
#define TOOLS_VERIFY_NET_INTERNAL_H

#include <float.h>
#include <stddef.h>

#include "tools/proof/double_interval.h"
#include "tools/verify/net.h"

/* A rounding of 1 */
#define ROUNDING (0.5 * DBL_EPSILON)

/* Covers the roundings of an error that is a sum of at most a thousand terms, none of them
 * negative, and numbers too small to have all their digits. */
static inline double net_padded(double error) { return error * (1 + 0x1p-40) + PROOF_TINY; }

/* At most how far a number of an interval is from one within it. */
static inline double net_off(ld_interval x, double from)
{
    return proof_larger(proof_up(x.hi - from), proof_up(from - x.lo));
}

/* Bytes of a net, whose points are its last member. */
static inline size_t net_bytes(const net *x)
{
    return offsetof(net, p) + 3 * (size_t)(x->n[0] * x->n[1] * x->n[2]) * sizeof *x->p;
}

/* Sets sizes from points and errors; false: a point is no number, or infinite, as 0 times it
 * tells. */
bool net_take_sizes(net *x);

#endif
