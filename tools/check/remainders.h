/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_REMAINDERS_H
#define TOOLS_CHECK_REMAINDERS_H

#include "tools/check/subject.h"

/* How much a surface needs beside a quadratic
 * ===========================================
 * Over each region a quadratic is fitted to points of the surface, by least squares. The greatest
 * distance of a point from it is the least possible remainder, up to a factor near 1. */

/* Over the region, for each coordinate: the remainder that the host works with, by include or,
 * where that is NULL, by rate, and what is needed. Lengths; false: there is none. */
bool remainder_measure(const subject *s, const box *where, double claimed[3], double needed[3]);

/* A point that far off the surface, along its normal: the distance that a search finds over that
 * which the type claims. False: it claims none there. */
bool distance_measure(const subject *s, uint64_t *random, const box *where, double *ratio);

#endif
