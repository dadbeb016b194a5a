/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "tiny.h"

/* The mirror image, with slopes where bounds were asked for: a nothing of a rate cancels them. */

static void times(const void *self, double *lo, double *hi)
{
    (void)self;
    *lo = -INFINITY;
    *hi = INFINITY;
}

static imp_status eval(const void *self, size_t n, const double *p, double *x, double *error)
{
    (void)self;
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < 3; ++i) x[3 * k + i] = -p[4 * k + i];
    for (size_t k = 0; error != NULL && k < 3 * n; ++k) error[k] = 0;
    return IMP_STATUS_OK;
}

static imp_status rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    (void)self, (void)box;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) rates->m[i][j] = i == j ? -1 : 0;
    return IMP_STATUS_OK;
}

static const imp_map_type type = {
    .struct_size = sizeof type,
    .parameter_size = sizeof(imp_parameter),
    .name = "map_rate_negative",
    .summary = "the mirror image",
    .equation = "(-x, -y, -z)",
    .example = "map_rate_negative",
    .create = tiny_create,
    .destroy = tiny_destroy,
    .time_domain = times,
    .eval = eval,
    .rate = rate,
};
IMPINGE_MAP_PLUGIN("map_rate_negative", "1.0", "Apache-2.0", "tests", type);
