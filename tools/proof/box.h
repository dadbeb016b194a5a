/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_PROOF_BOX_H
#define TOOLS_PROOF_BOX_H

/* A box of 3 to 5 parameters, of 3 where intervals are of doubles (ld_interval.h). Points and boxes
 * have n numbers each; those beyond n are 0. */

#ifdef PROOF_DOUBLE
enum { BOX_DIMS = 3 };
#else
enum { BOX_DIMS = 5 };
#endif

typedef struct box {
    double lo[BOX_DIMS], hi[BOX_DIMS]; /* lo <= hi, finite */
} box;

#endif
