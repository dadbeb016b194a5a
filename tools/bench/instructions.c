/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/bench/instructions.h"

#include <math.h>
#include <stdint.h>
#include <unistd.h>

#ifdef __linux__
#include <linux/perf_event.h>
#include <sys/syscall.h>

int instructions_start(void)
{
    struct perf_event_attr what = {.type = PERF_TYPE_HARDWARE,
                                   .size = sizeof what,
                                   .config = PERF_COUNT_HW_INSTRUCTIONS,
                                   .exclude_kernel = 1,
                                   .exclude_hv = 1};
    return (int)syscall(SYS_perf_event_open, &what, 0, -1, -1, PERF_FLAG_FD_CLOEXEC);
}
#else
int instructions_start(void) { return -1; }
#endif

double instructions_stop(int counter)
{
    if (counter < 0) return NAN;
    uint64_t count;
    const ssize_t size = read(counter, &count, sizeof count);
    close(counter);
    return size == (ssize_t)sizeof count ? (double)count : NAN;
}
