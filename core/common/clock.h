/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_CLOCK_H
#define CORE_COMMON_CLOCK_H

#include <time.h>

/* The time of the monotonic clock (CLOCK_MONOTONIC), which nobody sets. */
static inline struct timespec clock_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t;
}

/* Reads the monotonic clock in seconds. */
static inline double clock_seconds(void)
{
    const struct timespec t = clock_now();
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Reads the processor time of the calling thread in seconds. */
static inline double clock_thread_seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#endif
