/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/progress.h"

#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

static struct timespec begun;
static atomic_bool shown;

void progress_begin(void) { clock_gettime(CLOCK_MONOTONIC, &begun); }

static double seconds_since_begun(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - begun.tv_sec) + 1e-9 * (double)(now.tv_nsec - begun.tv_nsec);
}

void progress_show(const char *format, ...)
{
    char text[80]; /* a line that wraps could not be wiped */
    va_list list;
    const double seconds = seconds_since_begun();
    if (seconds < 1 || !isatty(STDERR_FILENO)) return;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    atomic_store(&shown, true);
    fprintf(stderr, "\r%.0f s: %.68s\033[K", seconds, text);
}

void progress_wipe(void)
{
    if (atomic_exchange(&shown, false)) fputs("\r\033[K", stderr);
}
