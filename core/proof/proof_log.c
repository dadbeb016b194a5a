/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/proof/proof_log.h"

#include <math.h>
#include <stdlib.h>

#include "core/common/array.h"

/* Scales the axis so that its greatest coordinate becomes 32767. */
static void take_axis(int16_t taken[3], const double axis[3])
{
    double most = 0;
    for (int i = 0; i < 3; ++i)
        if (fabs(axis[i]) > most) most = fabs(axis[i]);
    const bool is_one = most > 0 && most < INFINITY && isfinite(axis[0] + axis[1] + axis[2]);
    for (int i = 0; i < 3; ++i) taken[i] = is_one ? (int16_t)lrint(axis[i] / most * 32767) : 0;
}

uint32_t proof_log_add(proof_log *log, unsigned step, uint32_t parent, const double axis[3],
                       double lo, double hi)
{
    proof_record *grown = log->count < UINT32_MAX
                              ? array_reserve(log->at, log->count, &log->capacity, sizeof *grown)
                              : NULL;
    if (grown == NULL) {
        log->failed = true;
        return 0;
    }
    log->at = grown;
    proof_record *made = &grown[log->count];
    *made = (proof_record){.lo = lo, .hi = hi, .parent = parent, .step = (uint8_t)step};
    take_axis(made->axis, axis);
    return (uint32_t)log->count++;
}

void proof_log_clear(proof_log *log)
{
    free(log->at);
    *log = (proof_log){0};
}
