/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_KERNEL_TIME_H
#define TOOLS_BENCH_KERNEL_TIME_H

#include <stdbool.h>
#include <stddef.h>

/* What impinge-verify-kernel takes to prove certificates that impinge-verify has elaborated. */

enum { KERNEL_TIME_LIMIT = 3 }; /* processor seconds in which a certificate is to be elaborated */

typedef struct kernel_time {
    char *program; /* NULL: there is none */
    char folder[64], file[80];
    double *takes; /* processor seconds of the kernel, for each that was elaborated */
    size_t elaborated, proved;
} kernel_time;

/* Looks for the kernel, for at most that many certificates; without a folder for temporary files it
 * counts as missing. False: no memory. kernel_time_end is called in any case. */
bool kernel_time_begin(kernel_time *k, size_t most);

/* Elaborates the certificate of that path within the limit, and has the kernel prove it. */
void kernel_time_add(kernel_time *k, const char *verifier, const char *path);

void kernel_time_end(kernel_time *k);

/* Processor seconds of the programs that have run. */
double kernel_time_of_programs(void);

#endif
