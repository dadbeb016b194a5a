/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The center of the symmetry is not a number. */
static imp_status symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    found->kind = IMP_SYMMETRY_ABOUT_POINT;
    found->center[1] = NAN;
    return IMP_STATUS_OK;
}
LIAR_SYMMETRY("symmetry_nan", symmetry);
