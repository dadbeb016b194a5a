/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLID_COPIES_H
#define CORE_SOLID_COPIES_H

#include "core/solid/edges.h"

/* Patches that are there more than once
 * =====================================
 * Two patches are copies of each other if they have the same edges, in any order and direction, and
 * points in the middle of the one lie on the other. They are compared at points, within the slack
 * of the edges, whatever their parameters are. */

/* Sets one[i], for each patch, to the number of the patch that stands for it and all its copies.
 * False: no memory. */
bool copies_find(const edges *e, size_t *one);

#endif
