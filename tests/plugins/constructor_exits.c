/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>

#include "tiny.h"

/* Ends the process while it is loaded, and says that all is well. */
__attribute__((constructor)) static void sin_of_it(void) { exit(0); }

static const imp_surface_type type =
    TINY_TYPE("constructor_exits", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("constructor_exits", type);
