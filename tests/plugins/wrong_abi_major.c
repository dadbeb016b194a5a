/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* Built by the headers of a future that shares nothing with ours. */
#undef IMP_ABI_MAJOR
#define IMP_ABI_MAJOR 9

static const imp_surface_type type = TINY_TYPE("wrong_abi_major", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("wrong_abi_major", type);
