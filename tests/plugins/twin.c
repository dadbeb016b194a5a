/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* No sin, but a type whose name "kit.c" has too. */
static const imp_surface_type type = TINY_TYPE("kit", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("twin", type);
