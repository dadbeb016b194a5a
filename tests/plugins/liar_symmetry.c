/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* A pipe as it is, of which it says that it were a ball. */
static imp_status symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    found->kind = IMP_SYMMETRY_ABOUT_POINT;
    return IMP_STATUS_OK;
}
LIAR_SYMMETRY("liar_symmetry", symmetry);
