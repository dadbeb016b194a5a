/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Cannot say where its points are. */
static const imp_surface_type type = TINY_TYPE("null_callback", tiny_create, NULL, 0, NULL);
TINY_PLUGIN("null_callback", type);
