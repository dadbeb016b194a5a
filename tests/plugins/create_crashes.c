/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <signal.h>

#include "slab.h"

/* Crashes before there is an instance. */
static imp_status create(const imp_value *values, void **self, imp_create_error *why)
{
    raise(SIGSEGV);
    return slab_create(values, self, why);
}

static const imp_surface_type type =
    SLAB_TYPE("create_crashes", create, slab_domain, slab_eval, slab_rate, slab_include);
SLAB_PLUGIN("create_crashes", type);
