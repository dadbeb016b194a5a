/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_TUBES_H
#define TOOLS_CHECK_TUBES_H

#include "tools/check/subject.h"

/* Tries to refute tubes (imp_tube)
 * ================================
 * Tests the line in the middle of a surface over regions: form, and that points of the surface, at
 * any v of the domain, are within the radius and the line's remainder of it. Skips types that have
 * none. */
void tubes_check(const subject *s, uint64_t *random, double effort);

#endif
