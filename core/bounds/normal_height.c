/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/normal_height.h"

IMP_QUAD_INLINE void quadratics_least(const quadratics *p, double least[IMP_QUAD])
{
    imp_quad_store(least, quadratics_lower(p));
}

IMP_QUAD_WIDE static void quadratics_least_wide(const quadratics *p, double least[IMP_QUAD])
{
    quadratics_least(p, least);
}

static void least_values(const quadratics *p, double least[IMP_QUAD])
{
    if (imp_quad_is_wide())
        quadratics_least_wide(p, least);
    else
        quadratics_least(p, least);
}

bool height_least(const height *h, bool is_whole, height_line *line)
{
    const imp_quad seen = imp_quad_min(quadratics_corner(&h->parts), imp_quad_all(0));
    if (h->offset - h->drift + (seen[0] + seen[1]) <= 0 &&
        h->offset + h->drift + (seen[2] + seen[3]) <= 0)
        return false; /* nothing can be cut, even without slack */
    double least[IMP_QUAD];
    least_values(&h->parts, least);
    const double start = least[0] + least[1], end = least[2] + least[3];
    line->middle = h->offset + 0.5 * (start + end) + (h->bend < 0 ? h->bend : 0);
    line->drift = h->drift + 0.5 * (end - start);
    return is_whole || !(line->middle + fabs(line->drift) <= 0);
}

IMP_QUAD_INLINE imp_quad along_edges(const double edge[3][4], vec3 n)
{
    return imp_quad_all(n.x[0]) * imp_quad_load(edge[0]) +
           imp_quad_all(n.x[1]) * imp_quad_load(edge[1]) +
           imp_quad_all(n.x[2]) * imp_quad_load(edge[2]);
}

double edges_upper(const difference *r, vec3 n)
{
    imp_quad sum = imp_quad_all(0);
    for (int k = 0; k < r->posed; ++k)
        sum += imp_quad_abs(along_edges(r->edge[k], n)) + imp_quad_abs(along_edges(r->swing[k], n));
    return sum[0] + sum[1] + sum[2];
}

double bending_upper(const difference *r, vec3 n)
{
    double sum = 0;
    const slice *both[2] = {&r->a, &r->b};
    for (int k = 0; k < 2 && r->posed > 0; ++k)
        sum += fabs(vec3_dot(n, vec3_from(both[k]->uuw))) +
               fabs(vec3_dot(n, vec3_from(both[k]->uvw))) +
               fabs(vec3_dot(n, vec3_from(both[k]->vvw)));
    return sum;
}
