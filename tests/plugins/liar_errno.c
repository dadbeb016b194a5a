/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

#include <errno.h>

/* errno is set on the way. */
static imp_status rate(const void *self, const imp_region *region, imp_rate_matrix *rates)
{
    errno = ERANGE;
    return wavy_formula_rate(self, region, rates);
}
LIAR_RATE("liar_errno", rate);
