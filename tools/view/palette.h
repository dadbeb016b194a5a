/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PALETTE_H
#define TOOLS_VIEW_PALETTE_H

#include <stddef.h>

#include "tools/view/raster.h"

/* Colours that can be told apart
 * ==============================
 * Colours are compared in Oklab (B. Ottosson, 2020), where a distance of some 0.02 is just seen.
 * Any two of the first 16 are at least PALETTE_FAR apart, any two of all at least PALETTE_NEAR, and
 * the list repeats after the last. All are as far from the red of marks, from black and from
 * white. */

enum { PALETTE_COUNT = 24, PALETTE_FIRST = 16 };
#define PALETTE_FAR 0.11
#define PALETTE_NEAR 0.09

/* Returns the colour of body or curve number k. */
colour palette_colour(size_t k);

/* The colour of contacts and marks. */
extern const colour palette_mark;

/* Returns the distance in Oklab. */
double palette_distance(colour a, colour b);

#endif
