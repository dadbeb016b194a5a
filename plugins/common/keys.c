/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/keys.h"

#include <math.h>

#define UNIT_SLACK 1e-6

imp_status keys_check_times(int row, const imp_value *times, imp_create_error *why)
{
    if (times->count < 2) return imp_reject(why, row, -1, "a single key; must be two or more");
    for (size_t i = 1; i < times->count; ++i)
        if (!(times->number[i - 1] < times->number[i]))
            return imp_reject(why, row, (int64_t)i, "%.17g after %.17g; times must increase",
                              times->number[i], times->number[i - 1]);
    return IMP_STATUS_OK;
}

imp_status keys_check_rotations(int row, const imp_value *rotations, imp_create_error *why)
{
    for (size_t i = 0; i < rotations->count / 4; ++i) {
        const double *q = rotations->number + 4 * i;
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        if (!(fabs(length - 1) <= UNIT_SLACK))
            return imp_reject(why, row, (int64_t)i,
                              "[%g,%g,%g,%g] has length %.9g; must be 1 within %g", q[0], q[1],
                              q[2], q[3], length, UNIT_SLACK);
    }
    return IMP_STATUS_OK;
}
