/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Could never be written on a command line. */
static const imp_surface_type type = TINY_TYPE("bad name!", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("bad_name", type);
