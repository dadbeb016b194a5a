/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/simulate/limits.h"

#include "core/common/clock.h"
#include "tools/cli/interrupt.h"

limits limits_begin(double max_seconds, uint64_t max_pairs)
{
    return (limits){.deadline = max_seconds > 0 ? clock_seconds() + max_seconds : INFINITY,
                    .max_pairs = max_pairs};
}

void limits_reserve(limits *l, double seconds)
{
    const double left = l->deadline - clock_seconds();
    if (left > 0) l->deadline -= seconds < left ? seconds : left;
}

imp_reason limits_reached(const limits *l)
{
    if (interrupt_came()) return IMP_REASON_CANCELLED;
    return l->deadline < INFINITY && clock_seconds() >= l->deadline ? IMP_REASON_SECONDS
                                                                    : IMP_REASON_NONE;
}

static bool goes_on(void *context, const imp_progress *progress)
{
    (void)context, (void)progress;
    return !interrupt_came();
}

void limits_apply(const limits *l, imp_options *options)
{
    options->progress = goes_on;
    options->max_seconds = l->deadline < INFINITY ? fmax(l->deadline - clock_seconds(), 1e-9) : 0;
    options->max_pairs = l->max_pairs == 0         ? 0
                         : l->pairs < l->max_pairs ? l->max_pairs - l->pairs
                                                   : 1;
}
