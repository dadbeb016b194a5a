/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VERIFY_SHADOW_INTERNAL_H
#define TOOLS_VERIFY_SHADOW_INTERNAL_H

#include "tools/verify/shadow.h"

/* What shadow.c consists of: shadow_round.c bounds areas at all angles. */

/* Computes how much what a side reaches depends on each variable, by its derivatives, about; where
 * these have no bounds, by those of its parts. */
void shadow_find_sizes(const jet *over, const jet *at, const jet parts[], int count,
                       const double half[VARIABLES], double size[VARIABLES]);

/* Bounds how far an area reaches along n at any angle. *size: NULL, or how much it depends on each
 * variable. False: it is not known. */
bool shadow_at_all_angles(memory *known, const area *s, const aim *a, ld_interval *to,
                          double *at_centre, double *size);

#endif
