/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_FP_MODE_H
#define CORE_BASE_FP_MODE_H

#include "core/common/c_locale.h"
#include "core/common/fp_control.h"

/* The floating-point mode around calls
 * ====================================
 * Every bound in Impinge assumes rounding to nearest with subnormals kept. A shared object linked
 * with -ffast-math switches subnormals off in its constructor, for the whole thread that
 * loads it; a plugin's function may leave another rounding mode behind. Reading the mode
 * (fp_control.h) costs a few nanoseconds, so it is compared around every call out of core. */

/* --- The environment of a call ------------------------------------------------------------
 *
 * The program that embeds the library may have set any mode: directed rounding, flush-to-zero,
 * traps. Every public function that computes, or that runs code of a plugin, begins with
 * fp_environment_enter and ends with fp_environment_leave. Between them the default holds: round
 * to nearest, subnormals kept, exceptions masked, x87 with 64 bits. Threads and processes started
 * in between inherit it. The program's own environment, sticky flags included, comes back. The C
 * locale holds too, so that numbers are read and written with a point.
 *
 * Compilers do not know that arithmetic depends on the mode and may move it past either call. So
 * what is computed stands in a function of its own, marked FP_APART, which is not inlined: calls of
 * functions that write memory keep their order. */

#define FP_APART __attribute__((noinline))

typedef struct fp_environment {
    fenv_t callers;
    c_locale locale;
} fp_environment;

static inline fp_environment fp_environment_enter(void)
{
    fp_environment environment;
    fegetenv(&environment.callers);
    if (!fp_mode_is_default()) fesetenv(FE_DFL_ENV);
    environment.locale = c_locale_enter();
    return environment;
}

static inline void fp_environment_leave(const fp_environment *environment)
{
    c_locale_leave(&environment->locale);
    fesetenv(&environment->callers);
}

#endif
