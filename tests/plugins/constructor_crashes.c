/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <signal.h>

#include "tiny.h"

/* Crashes while it is loaded. */
__attribute__((constructor)) static void sin_of_it(void) { raise(SIGSEGV); }

static const imp_surface_type type =
    TINY_TYPE("constructor_crashes", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("constructor_crashes", type);
