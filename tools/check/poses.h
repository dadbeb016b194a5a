/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_POSES_H
#define TOOLS_CHECK_POSES_H

#include "tools/check/subject.h"

/* Tries to refute poses (imp_pose)
 * ================================
 * Tests rigid of a map: form, that the pose is a rotation, that points move as it says, and that
 * ranges and rates of its entries hold. An entry is seen from the images of two points: the pivot
 * and one beside it. Skips what has none. */
void poses_check(const subject *s, uint64_t *random, double effort);

#endif
