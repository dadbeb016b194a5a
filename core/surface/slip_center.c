/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/model.h>
#include <string.h>

#include "core/surface/slip.h"

/* Estimates how a point carried by b's maps moves from one time to another, in a's coordinates. */
static imp_status way_of(const slip_input *q, const double point[3], const imp_region *other,
                         double way[3])
{
    slip_input p = *q;
    slip_place now, then;
    p.found.kind = IMP_SYMMETRY_ABOUT_POINT;
    memcpy(p.found.center, point, sizeof p.found.center);
    imp_status status = slip_locate(&p, &q->then, &then);
    if (status == IMP_STATUS_OK) status = slip_locate(&p, other, &now);
    for (int i = 0; i < 3 && status == IMP_STATUS_OK; ++i)
        way[i] = now.feature[0].at[i].a - then.feature[0].at[i].a;
    return status;
}

/* Finds two directions across the axis of the plane. */
static void directions_across(const double axis[3], double across[2][3])
{
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (fabs(axis[i]) < fabs(axis[least])) least = i;
    double side[3] = {0, 0, 0};
    side[least] = 1;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[0][i] = axis[j] * side[k] - axis[k] * side[j];
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[1][i] = axis[j] * across[0][k] - axis[k] * across[0][j];
    }
}

#define SINGULAR 0x1p-30

/* The motion depends linearly on the point. */
imp_status slip_choose_center(slip_input *q, const imp_region *times)
{
    const double t = times->lo[2] + 0.375 * (times->hi[2] - times->lo[2]);
    const imp_region other = slip_at_times(times, t, t);
    double across[2][3], way[3][3], *center = q->found.center;
    directions_across(q->found.axis, across);
    imp_status status = way_of(q, center, &other, way[0]);
    for (int k = 0; k < 2 && status == IMP_STATUS_OK; ++k) {
        double point[3];
        for (int i = 0; i < 3; ++i) point[i] = center[i] + across[k][i];
        status = way_of(q, point, &other, way[k + 1]);
        for (int i = 0; i < 3; ++i) way[k + 1][i] -= way[0][i];
    }
    if (status != IMP_STATUS_OK) return status;
    const double a = slip_dot(way[1], way[1]), b = slip_dot(way[1], way[2]),
                 c = slip_dot(way[2], way[2]);
    const double det = a * c - b * b, r = -slip_dot(way[1], way[0]), s = -slip_dot(way[2], way[0]);
    if (!(det > SINGULAR * a * c)) return IMP_STATUS_OK;
    const double along[2] = {(c * r - b * s) / det, (a * s - b * r) / det};
    for (int i = 0; i < 3; ++i) center[i] += along[0] * across[0][i] + along[1] * across[1][i];
    return IMP_STATUS_OK;
}
