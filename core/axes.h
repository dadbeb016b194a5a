/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_AXES_H
#define CORE_AXES_H

#include "relative.h"

/* Separation along fixed axes
 * ===========================
 * Four axes at a time, one in each lane of a vector, because nearly every pair is tried along
 * all of them. The vector width is chosen when the program runs; the operations and
 * their order are the same on every machine, so the answers are too. */

/* Cuts the share to the w at which no axis shows the nodes apart; false: none is left. */
bool axes_cut(const relative *r, double clearance, share *s);

#endif
