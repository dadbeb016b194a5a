/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/heap_growth.h"

#include <math.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#if defined(__GLIBC__) && defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 33)
#define COUNTS_MEMORY 1
#endif
#endif

/* Bytes allocated by malloc, or 0 if it does not report them. */
static double bytes_in_use(void)
{
#ifdef COUNTS_MEMORY
    const struct mallinfo2 m = mallinfo2();
    return (double)m.uordblks + (double)m.hblkhd;
#else
    return 0;
#endif
}

enum { SPELLS = 48 };

double heap_growth_lower(bool (*repeated)(const void *), const void *context, int rounds)
{
    double least = INFINITY;
    for (int spell = 0; spell < SPELLS && least >= HEAP_BLOCK_LEAST * rounds; ++spell) {
        const double before = bytes_in_use();
        for (int k = 0; k < rounds; ++k)
            if (!repeated(context)) return 0;
        const double grown = bytes_in_use() - before;
        if (!(before > 0)) return -1;
        if (grown < least) least = grown;
    }
    return least > 0 ? least : 0;
}
