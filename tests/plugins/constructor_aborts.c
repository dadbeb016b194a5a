/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <stdlib.h>

#include "tiny.h"

/* Gives up while it is loaded. */
__attribute__((constructor)) static void sin_of_it(void) { abort(); }

static const imp_surface_type type =
    TINY_TYPE("constructor_aborts", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("constructor_aborts", type);
