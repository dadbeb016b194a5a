/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/facet.h"

double facet_greatest(const double x[3])
{
    return imp_larger(fabs(x[0]), imp_larger(fabs(x[1]), fabs(x[2])));
}

/* a times a power of two, so that its greatest component is from 1/2 to 1, and b alike; components
 * that underflow are negligible, as the normal need not be accurate. */
static void normal_across(const double a[3], const double b[3], double n[3])
{
    int of_a, of_b;
    frexp(facet_greatest(a), &of_a);
    frexp(facet_greatest(b), &of_b);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = ldexp(a[j], -of_a) * ldexp(b[k], -of_b) - ldexp(a[k], -of_a) * ldexp(b[j], -of_b);
    }
}

/* Lemma (length). |n| as computed is within 4 roundings, each quotient within one more: so each
 * component is at most 1 + 8 u times that of a unit vector, and (1 - 2^-48), rounded, takes off 30
 * u. */
static void set_normal(facet *s, const double u[3], const double v[3])
{
    double n[3], along[2] = {0, 0}, size = 0;
    normal_across(u, v, n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int i = 0; i < 3; ++i) {
        s->normal[i] = length > 0x1p-400 ? n[i] / length * (1 - 0x1p-48) : 0;
        along[0] += s->normal[i] * u[i];
        along[1] += s->normal[i] * v[i];
        size += fabs(s->normal[i] * u[i]) + fabs(s->normal[i] * v[i]);
    }
    s->flatness = (fabs(along[0]) + fabs(along[1])) + 0x1p-48 * size + IMP_TINY;
}

void facet_span(facet *s, const double origin[3], const double edge_u[3], const double edge_v[3])
{
    memset(s, 0, sizeof *s);
    linear *f = &s->surface;
    for (int i = 0; i < 3; ++i) {
        f->still[LINEAR_1][i] = origin[i];
        f->still[LINEAR_U][i] = edge_u[i];
        f->still[LINEAR_V][i] = edge_v[i];
    }
    linear_finish(f);
    set_normal(s, edge_u, edge_v);
}

/* n.(x - origin), the distance from the endless plane. Lemma. Let |n| <= 1 and y = origin + u
 * edge_u + v edge_v, u and v in [0, 1]. Then |x - y| >= |n.(x - origin) - n.(y - origin)|, and the
 * last is at most |n.edge_u| + |n.edge_v| <= flatness, in which 2^-48 is 32 u of the terms' size:
 * products and sums round 4 times, those of flatness itself 3. So n need not be accurate. */
imp_model facet_gap(const facet *s, imp_model x, imp_model y, imp_model z)
{
    const double *origin = s->surface.still[LINEAR_1];
    const imp_model n[3] = {imp_num(s->normal[0]), imp_num(s->normal[1]), imp_num(s->normal[2])};
    const imp_model m[3] = {imp_shift(x, -origin[0]), imp_shift(y, -origin[1]),
                            imp_shift(z, -origin[2])};
    return imp_add(imp_dot3(m, n), imp_between(-s->flatness, s->flatness));
}

/* n.(x - origin) does not change where x turns about the line through origin along n, or moves
 * across it. */
imp_status facet_symmetry(const void *self, imp_symmetry *symmetry)
{
    const facet *s = self;
    symmetry->kind = IMP_SYMMETRY_ACROSS_LINE;
    memcpy(symmetry->center, s->surface.still[LINEAR_1], sizeof symmetry->center);
    memcpy(symmetry->axis, s->normal, sizeof symmetry->axis);
    return facet_greatest(s->normal) > 0 ? IMP_STATUS_OK : IMP_STATUS_UNBOUNDED;
}
