/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/keys.h"

#include <math.h>
#include <string.h>

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

imp_status keys_check_count(const imp_parameter *parameters, const imp_value *values, int row,
                            size_t wanted, imp_create_error *why)
{
    if (!imp_is_given(&values[row]) || values[row].extent[0] == wanted) return IMP_STATUS_OK;
    return imp_reject(why, row, -1, "%zu %s for %zu times; must be %zu", values[row].extent[0],
                      parameters[row].name, values[0].count, wanted);
}

const double *keys_keep(const imp_value *list, double **room)
{
    double *to = *room;
    if (!imp_is_given(list)) return NULL;
    memcpy(to, list->number, list->count * sizeof *to);
    *room += list->count;
    return to;
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

void keys_define(const imp_text_sink *to, const char *name, const double *list, size_t count)
{
    for (size_t k = 0; k < count; ++k) imp_define_at(to, name, k, list[k]);
}
