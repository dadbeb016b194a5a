/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_FP_CONTROL_H
#define CORE_COMMON_FP_CONTROL_H

#include <fenv.h>
#include <stdbool.h>
#include <stdint.h>

/* The floating-point mode of this thread
 * ======================================
 * The mode is what steers results: rounding, flush-to-zero, denormals-are-zero, exceptions that
 * trap; on x86 also rounding, precision and traps of the x87 unit, in which long double is
 * computed. The sticky exception flags are not part of it. */

typedef uint64_t fp_mode;

#if defined(__x86_64__)

#define FP_MODE_FLAGS 0x3Fu  /* MXCSR bits 0 to 5: the sticky exception flags */
#define FP_MODE_X87 0x0F3Fu  /* x87 control word: masks of traps (0 to 5), precision, rounding */
#define FP_MODE_X87_SHIFT 32 /* its place in an fp_mode, above MXCSR */

/* The mode that FE_DFL_ENV sets: all exceptions masked; x87: 64 bits. */
#define FP_MODE_DEFAULT ((fp_mode)0x033Fu << FP_MODE_X87_SHIFT | 0x1F80u)

static inline fp_mode fp_mode_read(void)
{
    uint16_t x87;
    __asm__ volatile("fnstcw %0" : "=m"(x87));
    return (fp_mode)(x87 & FP_MODE_X87) << FP_MODE_X87_SHIFT |
           (__builtin_ia32_stmxcsr() & ~FP_MODE_FLAGS);
}

/* fldcw traps where an exception is pending and not masked, so the flags are cleared first. */
static inline void fp_mode_restore(fp_mode mode)
{
    const uint16_t x87 = (uint16_t)(mode >> FP_MODE_X87_SHIFT);
    __asm__ volatile("fnclex\n\tfldcw %0" : : "m"(x87));
    __builtin_ia32_ldmxcsr((uint32_t)mode);
}

#elif defined(__aarch64__)

#define FP_MODE_DEFAULT ((fp_mode)0)

static inline fp_mode fp_mode_read(void)
{
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
    return fpcr;
}

static inline void fp_mode_restore(fp_mode mode) { __asm__ volatile("msr fpcr, %0" : : "r"(mode)); }

#else /* what C can tell everywhere: the rounding mode; glibc also tells which exceptions trap */

#if defined(__GLIBC__) && defined(__USE_GNU)
#define FP_MODE_TRAPS_SHIFT 32

static inline fp_mode fp_mode_read(void)
{
    return (fp_mode)(uint32_t)fegetexcept() << FP_MODE_TRAPS_SHIFT | (uint32_t)fegetround();
}

static inline void fp_mode_restore(fp_mode mode)
{
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept((int)(mode >> FP_MODE_TRAPS_SHIFT));
    fesetround((int)(uint32_t)mode);
}
#else
static inline fp_mode fp_mode_read(void) { return (fp_mode)fegetround(); }

static inline void fp_mode_restore(fp_mode mode) { fesetround((int)mode); }
#endif

#endif

/* Whether FE_DFL_ENV is known to change nothing but flags. */
static inline bool fp_mode_is_default(void)
{
#ifdef FP_MODE_DEFAULT
    return fp_mode_read() == FP_MODE_DEFAULT;
#else
    return false;
#endif
}

/* Returns true if the mode is still `before`; otherwise puts it back and returns false. */
static inline bool fp_mode_kept(fp_mode before)
{
    if (fp_mode_read() == before) return true;
    fp_mode_restore(before);
    return false;
}

#endif
