/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Innocent, but linked with -ffast-math: many toolchains then add a constructor that sets
 * subnormals to zero. */
static const imp_surface_type type = TINY_TYPE("fast_math", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("fast_math", type);
