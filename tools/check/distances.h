/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_DISTANCES_H
#define TOOLS_CHECK_DISTANCES_H

#include "tools/check/subject.h"

/* Tries to refute distances (imp_surface_type.distance)
 * =====================================================
 * Models of moving points are made to pass points of the surface, on it or a little way off along
 * its normal: no more may be claimed of their distance there. Skips types without it. */
void distances_check(const subject *s, uint64_t *random, double effort);

#endif
