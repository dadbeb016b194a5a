/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/surface/feature.h"

#include <impinge/model.h>
#include <string.h>

#include "core/base/rounding.h"

imp_status feature_carry(const surface *s, const imp_symmetry *of, const imp_region *times,
                         feature *f)
{
    carried center = {.off = 0};
    f->of = *of;
    for (int i = 0; i < 3; ++i) {
        center.at[i] = imp_num(of->center[i]);
        f->axis[i] = imp_num(of->axis[i]);
    }
    const imp_status status = carried_through(s, times, &center, 1, &f->axis);
    memcpy(f->center, center.at, sizeof f->center);
    return status;
}

void feature_difference(const imp_model y[3], const imp_model x[3], imp_model way[3])
{
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(y[i], x[i]);
}

double feature_reach_upper(const double lo[3], const double hi[3], const imp_model from[3])
{
    imp_model way[3];
    for (int i = 0; i < 3; ++i) way[i] = imp_sub(imp_between(lo[i], hi[i]), from[i]);
    return surface_size_upper(way);
}

double feature_inverse_length(const imp_symmetry *of)
{
    const double *x = of->axis;
    return 1 / sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

/* Roundings of the distance: 8 of the inverse length. */
PAD_COVERS(64, 8);
void feature_compare_lines(const feature *a, const feature *b, double *off, double *angle)
{
    imp_model way[3], n[2][3], across[3], turn[3];
    double length[2] = {feature_inverse_length(&a->of), feature_inverse_length(&b->of)}, cosine = 0;
    feature_difference(a->center, b->center, way);
    for (int i = 0; i < 3; ++i) cosine += a->axis[i].a * b->axis[i].a;
    if (cosine < 0) length[1] = -length[1];
    for (int i = 0; i < 3; ++i) {
        n[0][i] = imp_scale(a->axis[i], length[0]);
        n[1][i] = imp_scale(b->axis[i], length[1]);
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        across[i] = imp_sub(imp_mul(way[j], n[0][k]), imp_mul(way[k], n[0][j]));
    }
    feature_difference(n[0], n[1], turn);
    *off = padded_upper(surface_size_upper(across), 64);
    *angle = surface_size_upper(turn) + AXES_OFF;
}
