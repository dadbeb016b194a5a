/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_PARTS_H
#define TOOLS_CHECK_PARTS_H

#include "tools/check/subject.h"

/* Tries to refute what a map says of its parts (imp_map_type.parts). A scene can be made of them.
 * With every clock in the middle of its range they move points as eval does, also where parameters
 * that they name are 0: there the host leaves parts out, which must move nothing then. Points can
 * be evaluated at all values of the clocks. Types of other plugins are found as the command finds
 * them. */
void parts_check(const subject *s, uint64_t *random, double effort);

#endif
