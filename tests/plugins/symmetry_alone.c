/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "pipe.h"

/* A symmetry of distances, and no distances. */
static imp_status symmetry(const void *self, imp_symmetry *found)
{
    (void)self;
    found->kind = IMP_SYMMETRY_ALONG_LINE;
    found->axis[2] = 1;
    return IMP_STATUS_OK;
}
LIAR_PIPE("symmetry_alone", NULL, symmetry);
