/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_FP_MODE_H
#define CORE_BASE_FP_MODE_H

#include <fenv.h>
#include <stdbool.h>
#include <stdint.h>

/* The floating-point mode of this thread
 * ======================================
 * Every bound in Impinge assumes rounding to nearest with subnormals kept. A shared object linked
 * with -ffast-math switches subnormals off in its constructor, for the whole thread that
 * loads it; a plugin's function may leave another rounding mode behind. Reading the mode
 * costs about a nanosecond, so it is compared around every call out of core.
 *
 * The mode is what steers results: rounding, flush-to-zero, denormals-are-zero, traps. The sticky
 * exception flags are not part of it. */

/* --- The environment of a call ------------------------------------------------------------
 *
 * The program that embeds the library may have set any mode: directed rounding, flush-to-zero,
 * traps. Every public function that computes, or that runs code of a plugin, begins with
 * fp_environment_enter and ends with fp_environment_leave. Between them the default holds: round
 * to nearest, subnormals kept, exceptions masked, x87 with 64 bits. Threads and processes started
 * in between inherit it. The program's own environment, sticky flags included, comes back.
 *
 * Compilers do not know that arithmetic depends on the mode and may move it past either call. So
 * what is computed stands in a function of its own, marked FP_APART, which is not inlined: calls of
 * functions that write memory keep their order. */

#define FP_APART __attribute__((noinline))

typedef struct fp_environment {
    fenv_t callers;
} fp_environment;

static inline fp_environment fp_environment_enter(void)
{
    fp_environment environment;
    fegetenv(&environment.callers);
    fesetenv(FE_DFL_ENV);
    return environment;
}

static inline void fp_environment_leave(const fp_environment *environment)
{
    fesetenv(&environment->callers);
}

/* --- Who changed it ------------------------------------------------------------------------ */

typedef uint64_t fp_mode;

#if defined(__x86_64__)

#define FP_MODE_FLAGS 0x3Fu /* MXCSR bits 0 to 5: the sticky exception flags */

static inline fp_mode fp_mode_read(void) { return __builtin_ia32_stmxcsr() & ~FP_MODE_FLAGS; }

static inline void fp_mode_restore(fp_mode mode) { __builtin_ia32_ldmxcsr((uint32_t)mode); }

#elif defined(__aarch64__)

static inline fp_mode fp_mode_read(void)
{
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
    return fpcr;
}

static inline void fp_mode_restore(fp_mode mode) { __asm__ volatile("msr fpcr, %0" : : "r"(mode)); }

#else /* what C can tell everywhere: the rounding mode */

static inline fp_mode fp_mode_read(void) { return (fp_mode)fegetround(); }

static inline void fp_mode_restore(fp_mode mode) { fesetround((int)mode); }

#endif

/* True if the mode still is `before`; otherwise puts it back and answers false. */
static inline bool fp_mode_kept(fp_mode before)
{
    if (fp_mode_read() == before) return true;
    fp_mode_restore(before);
    return false;
}

#endif
