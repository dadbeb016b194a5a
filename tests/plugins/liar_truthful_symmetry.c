/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* The symmetry of the pipe without that lie. */
static imp_status symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    found->kind = IMP_SYMMETRY_ALONG_LINE;
    found->axis[2] = 2;
    return IMP_STATUS_OK;
}
LIAR_SYMMETRY("liar_truthful_symmetry", symmetry);
