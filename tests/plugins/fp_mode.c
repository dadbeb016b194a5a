/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <fenv.h>

#include "tiny.h"

/* Changes the arithmetic of whoever loads it: subnormals become zero where we know how to say
 * so, else rounding goes upward. */
__attribute__((constructor)) static void change_mode(void)
{
#if defined(__x86_64__)
    __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040u);
#else
    fesetround(FE_UPWARD);
#endif
}

static const imp_surface_type type = TINY_TYPE("fp_mode", tiny_create, tiny_eval, 0, NULL);
TINY_PLUGIN("fp_mode", type);
