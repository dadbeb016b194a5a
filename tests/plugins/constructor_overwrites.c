/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Ends the environment of the program before its first variable while it is loaded. */
__attribute__((constructor)) static void sin_of_it(int argc, char **argv, char **envp)
{
    (void)argc;
    (void)argv;
    envp[0] = NULL;
}

static const imp_surface_type type =
    TINY_TYPE("constructor_overwrites", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("constructor_overwrites", type);
