/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURFACE_SCREW_PIECE_H
#define CORE_SURFACE_SCREW_PIECE_H

#include "core/surface/feature.h"

/* Pieces of endless threads
 * =========================
 * A surface with screws that is CLOSED holds all images of its points under these that are not
 * higher or lower along the line than all of it. */

typedef struct screw_piece {
    imp_symmetry of;
    double lead;
    double lowest, highest; /* along the line from the center, before the maps: the surface has a
                               point no higher, and one no lower; length */
} screw_piece;

/* Computes it for these times. *is_one false: the type says nothing of the kind. */
imp_status screw_piece_measure(const surface *s, const imp_region *times, screw_piece *p,
                               bool *is_one);

/* >= how far an image may be from the surface for what is rounded, where all of the surface, and
 * the images' way along the line, are within `reach` of the center. Lemma. Image and way are within
 * reach and 2 reach, so that IMP_SCREW_SLACK is taken of 3 reach and a lead at most. */
static inline double screw_loose_upper(double reach, double lead)
{
    return IMP_SCREW_SLACK * 4 * (reach + lead);
}

#endif
