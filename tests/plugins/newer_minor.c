/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Built by headers newer than the host. */
#undef IMP_ABI_MINOR
#define IMP_ABI_MINOR 77

static const imp_surface_type type = TINY_TYPE("newer_minor", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("newer_minor", type);
