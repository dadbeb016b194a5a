/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_SAMPLING_H
#define TOOLS_CHECK_SAMPLING_H

#include <stddef.h>
#include <stdint.h>

/* Where the checker looks
 * =======================
 * Everything is drawn from a seed, so that a finding can be had again. Points and boxes have n
 * numbers each, 3 or 4; what lies beyond n is 0. */

enum { BOX_DIMS = 4 };

typedef struct box {
    double lo[BOX_DIMS], hi[BOX_DIMS]; /* lo <= hi, finite */
} box;

/* A stream of its own for each name. */
uint64_t draw_stream(uint64_t seed, const char *name, const char *other_name);

uint64_t draw_bits(uint64_t *random);
size_t draw_index(uint64_t *random, size_t count); /* below count */
double draw_between(uint64_t *random, double lo, double hi);
double draw_power(uint64_t *random, double lo, double hi); /* 2^k, k uniform */

/* Point k of a sequence that fills a unit cube evenly: any box of volume V in it is met within a
 * few times 1/V points. `shift` begins the sequence elsewhere. */
void draw_spread(const double shift[BOX_DIMS], uint64_t k, int n, double at[BOX_DIMS]);

/* The box around a place of `all` (in [0,1] along each dimension), of that fraction of its widths,
 * cut off at its ends. */
box draw_around(const box *all, int n, const double at[BOX_DIMS], double fraction);

/* A part of `all` of any size and shape: whole, half, tiny, a single value, at either end. */
box draw_box(uint64_t *random, const box *all, int n);

/* A point of the box, often at an end, in the middle, or where remainders of quadratics peak. */
void draw_point(uint64_t *random, const box *from, int n, double *p);

/* Another point of the box: anywhere, close by, or different in one number only. */
void draw_partner(uint64_t *random, const box *from, int n, const double *p, double *partner);

/* A number in [-1, 1], a multiple of 2^-10, often -1, 0 or 1. */
double draw_normalized(uint64_t *random);

#endif
