/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <unistd.h>

#include "tiny.h"

/* Never comes back from being loaded. */
__attribute__((constructor)) static void sin_of_it(void)
{
    for (;;) pause();
}

static const imp_surface_type type =
    TINY_TYPE("constructor_hangs", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("constructor_hangs", type);
