/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SAMPLING_H
#define TOOLS_CHECK_SAMPLING_H

#include <stddef.h>

#include "core/common/random.h"
#include "tools/proof/box.h"

/* Where the checker searches
 * ==========================
 * Everything is drawn from a seed, so that a result can be reproduced. Boxes: see
 * tools/proof/box.h. */

/* Returns a separate stream for each name. */
uint64_t draw_stream(uint64_t seed, const char *name, const char *other_name);

size_t draw_index(uint64_t *random, size_t count); /* below count */

/* Point k of a sequence that fills a unit cube evenly: any box of volume V in it is met within a
 * few times 1/V points. `shift` begins the sequence elsewhere. */
void draw_spread(const double shift[BOX_DIMS], uint64_t k, int n, double at[BOX_DIMS]);

/* Returns the box around a place of `all` (in [0,1] along each dimension), of that fraction of its
 * widths, cut off at its ends. */
box draw_around(const box *all, int n, const double at[BOX_DIMS], double fraction);

/* Returns a part of `all` of any size and shape: whole, half, tiny, a single value, at either end.
 * */
box draw_box(uint64_t *random, const box *all, int n);

/* Draws a point of the box, often at an end, in the middle, or where remainders of quadratics peak.
 * */
void draw_point(uint64_t *random, const box *from, int n, double *p);

/* Another point of the box: anywhere, close by, or different in one number only. */
void draw_partner(uint64_t *random, const box *from, int n, const double *p, double *partner);

/* Numbers of [lo, hi] that a formula may have a hole at, ascending or not: ends, halves and thirds,
 * tenths and eighths, parts of pi. At most SPECIAL_MAX; how many. */
enum { SPECIAL_MAX = 256 };
int special_values(double lo, double hi, double value[SPECIAL_MAX]);

/* Returns a number in [-1, 1], a multiple of 2^-10, often -1, 0 or 1. */
double draw_normalized(uint64_t *random);

#endif
