/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/reading_budget.h"

#include "core/common/clock.h"

reading_budget reading_budget_begin(const imp_registry *registry)
{
    return (reading_budget){.limits = registry_reading_limits(registry),
                            .start = clock_thread_seconds()};
}

static double seconds_used(const reading_budget *b) { return clock_thread_seconds() - b->start; }

bool reading_budget_allows(reading_budget *b, uint64_t more)
{
    if (b == NULL) return true;
    if (b->end != READING_GOES_ON) return false;
    const uint64_t most = b->limits.bytes;
    if (most > 0 && (b->bytes > most || more > most - b->bytes)) b->end = READING_OUT_OF_ROOM;
    if (b->limits.seconds > 0 && seconds_used(b) > b->limits.seconds) b->end = READING_OUT_OF_TIME;
    return b->end == READING_GOES_ON;
}

void reading_budget_take(reading_budget *b, uint64_t bytes)
{
    if (b != NULL && __builtin_add_overflow(b->bytes, bytes, &b->bytes)) b->bytes = UINT64_MAX;
}

reading_limits reading_budget_rest(const reading_budget *b)
{
    if (b == NULL) return (reading_limits){0, 0};
    reading_limits rest = b->limits;
    if (rest.bytes > 0) rest.bytes = rest.bytes > b->bytes ? rest.bytes - b->bytes : 1;
    if (rest.seconds > 0) {
        rest.seconds -= seconds_used(b);
        if (!(rest.seconds > 0)) rest.seconds = 1e-9; /* 0 would mean no limit */
    }
    return rest;
}

bool reading_budget_is_over(const reading_budget *b)
{
    return b != NULL && b->end != READING_GOES_ON;
}

imp_code reading_budget_refuse(const reading_budget *b, const place *at, imp_error *error)
{
    const char *limit = b->end == READING_OUT_OF_TIME ? "max_seconds" : "max_bytes";
    return place_error(at, error, IMP_ERROR_LIMIT,
                       "%s is not enough to read this; allow more (0: no limit)", limit);
}
