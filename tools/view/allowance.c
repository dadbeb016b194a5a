/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/allowance.h"

#include <math.h>
#include <stdio.h>
#include <unistd.h>

#include "core/common/clock.h"

/* Seconds between two checks of the memory held: at 2 GB a second, 10 MB are written meanwhile. A
 * check costs some microseconds. */
static const double look_interval = 5e-3;

/* Bytes in memory now; 0: not known. */
static uint64_t bytes_held(void)
{
    unsigned long long all, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL) return 0;
    if (fscanf(file, "%llu %llu", &all, &resident) != 2) resident = 0;
    fclose(file);
    return resident * (uint64_t)sysconf(_SC_PAGESIZE);
}

void allowance_begin(allowance *l, double seconds, uint64_t bytes)
{
    *l = (allowance){.seconds = seconds, .bytes = bytes, .begun = clock_seconds()};
    if (bytes > 0) l->held = bytes_held();
}

double allowance_left(const allowance *l, double share)
{
    if (l == NULL || !(l->seconds > 0)) return 0;
    return fmax(share * (l->seconds - (clock_seconds() - l->begun)), 1e-3);
}

bool allowance_is_near(const allowance *l)
{
    return l != NULL && l->seconds > 0 && clock_seconds() - l->begun > 0.9 * l->seconds;
}

static imp_code end(allowance *l, const char *what, imp_error *error)
{
    l->what = what;
    error->code = IMP_ERROR_MEMORY;
    return error->code;
}

static imp_code end_of_bytes(allowance *l, const char *what, imp_error *error)
{
    snprintf(
        error->text, sizeof error->text,
        "--max-bytes %llu is not enough: more was needed while %s; allow more (0: no limit), or "
        "ask for less exact surfaces (--tolerance)",
        (unsigned long long)l->bytes, what);
    return end(l, what, error);
}

imp_code allowance_check_bytes(allowance *l, size_t bytes, const char *what, imp_error *error)
{
    if (l == NULL) return IMP_SUCCESS;
    const double now = clock_seconds();
    if (l->seconds > 0 && now - l->begun > l->seconds) {
        snprintf(error->text, sizeof error->text,
                 "--max-seconds %g was over while %s; allow more (0: no limit)", l->seconds, what);
        return end(l, what, error);
    }
    if (l->interrupted != NULL && l->interrupted() && !l->heard) {
        snprintf(error->text, sizeof error->text, "interrupted while %s", what);
        return end(l, what, error);
    }
    if (l->bytes == 0 || (now < l->next && bytes < l->bytes / 100)) return IMP_SUCCESS;
    l->next = now + look_interval;
    const uint64_t held = bytes_held(), own = held > l->held ? held - l->held : 0;
    return own + bytes > l->bytes ? end_of_bytes(l, what, error) : IMP_SUCCESS;
}

imp_code allowance_check(allowance *l, const char *what, imp_error *error)
{
    return allowance_check_bytes(l, 0, what, error);
}

bool allowance_ended(const allowance *l) { return l->what != NULL; }

void allowance_begin_drawing(allowance *l)
{
    l->heard = l->interrupted != NULL && l->interrupted();
}
