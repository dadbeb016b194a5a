/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_NETS_H
#define TOOLS_CHECK_NETS_H

#include "tools/check/subject.h"

/* Tries to refute control nets (imp_net)
 * ======================================
 * Tests net of a surface, or of a map that is given nets whose points are exact: form, and that
 * points of the surface lie on the patch of the net within its error. Skips types that have
 * none. */
void nets_check(const subject *s, uint64_t *random, double effort);

#endif
