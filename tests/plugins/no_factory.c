/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Offers nothing the host has heard of. */
static const void *get_factory(const char *id)
{
    (void)id;
    return NULL;
}
IMPINGE_PLUGIN("no_factory", "1.0", "Apache-2.0", "tests", get_factory);
