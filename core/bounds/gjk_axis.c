/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/gjk_axis.h"

#include "core/bounds/gjk.h"

#include <impinge/quad.h>

/* --- The point that lies lowest along a direction --------------------------------------------- */

/* B - A at a moment: centre, forms of B (0) and of -A (1), and the slack's box; the edges of posed
 * nodes are left out. The lanes hold x, y, z and 0; slope, curvature and twist hold the forms
 * again, by coordinate, with the lanes (u of B, u of -A, v of B, v of -A). */
typedef struct shape {
    imp_quad centre, slack;
    imp_quad bu[2], bv[2], quu[2], quv[2], qvv[2];
    imp_quad slope[3], curvature[3], twist[3];
} shape;

/* `bends`, here and below, is constant in each caller. If false, the curvature is 0 and its fields
 * are not set. */

IMP_QUAD_INLINE void shape_take(shape *z, int k, const slice *f, double w, imp_quad sign)
{
    const imp_quad at = imp_quad_all(w);
    z->bu[k] = sign * (imp_quad_load(f->bu) + at * imp_quad_load(f->quw));
    z->bv[k] = sign * (imp_quad_load(f->bv) + at * imp_quad_load(f->qvw));
    z->quu[k] = sign * imp_quad_load(f->quu);
    z->quv[k] = sign * imp_quad_load(f->quv);
    z->qvv[k] = sign * imp_quad_load(f->qvv);
}

IMP_QUAD_INLINE shape shape_at(const difference *r, double w, bool bends)
{
    shape z;
    z.centre = imp_quad_load(r->delta) + imp_quad_all(w) * imp_quad_load(r->drift) +
               imp_quad_all(w * w) * imp_quad_load(r->bend);
    z.slack = imp_quad_load(r->slack);
    shape_take(&z, 0, &r->b, w, imp_quad_all(1));
    shape_take(&z, 1, &r->a, w, imp_quad_all(-1));
    for (int i = 0; i < 3; ++i) {
        z.slope[i] = (imp_quad){z.bu[0][i], z.bu[1][i], z.bv[0][i], z.bv[1][i]};
        if (bends) z.curvature[i] = (imp_quad){z.quu[0][i], z.quu[1][i], z.qvv[0][i], z.qvv[1][i]};
        z.twist[i] = (imp_quad){z.quv[0][i], z.quv[1][i], z.quv[0][i], z.quv[1][i]};
    }
    return z;
}

IMP_QUAD_INLINE imp_quad along(vec3 n, const imp_quad x[3])
{
    return x[0] * imp_quad_all(n.x[0]) + x[1] * imp_quad_all(n.x[1]) + x[2] * imp_quad_all(n.x[2]);
}

/* Returns the s in [-1, 1] at which b s is least. */
IMP_QUAD_INLINE imp_quad lower_end(imp_quad b)
{
    return imp_quad_pick(b > imp_quad_all(0), imp_quad_all(-1), imp_quad_all(1));
}

/* Returns the s in [-1, 1] at which b s + q s^2 is least; `vertex` is -1 / 2q. */
IMP_QUAD_INLINE imp_quad least_at(imp_quad b, imp_quad q, imp_quad vertex)
{
    const imp_quad one = imp_quad_all(1), end = lower_end(b);
    const imp_quad inside = imp_quad_max(imp_quad_min(b * vertex, one), -one);
    return imp_quad_pick(q > imp_quad_all(0x1p-1000), inside, end);
}

/* Estimates the parameters (s_u of B, s_u of -A, s_v of B, s_v of -A) at which both forms are least
 * along n: minimises over u, then v, then u. */
IMP_QUAD_INLINE imp_quad shape_bottom(const shape *z, vec3 n, bool bends)
{
    const imp_quad slope = along(n, z->slope), twist = along(n, z->twist);
    if (!bends) {
        const imp_quad s = lower_end(slope);
        const imp_quad v = lower_end(slope + twist * (imp_quad){s[2], s[3], s[0], s[1]});
        const imp_quad u = lower_end(slope + twist * (imp_quad){v[2], v[3], v[2], v[3]});
        return (imp_quad){u[0], u[1], v[2], v[3]};
    }
    const imp_quad curvature = along(n, z->curvature);
    const imp_quad vertex = imp_quad_all(-0.5) / curvature;
    const imp_quad s = least_at(slope, curvature, vertex);
    const imp_quad v =
        least_at(slope + twist * (imp_quad){s[2], s[3], s[0], s[1]}, curvature, vertex);
    const imp_quad u =
        least_at(slope + twist * (imp_quad){v[2], v[3], v[2], v[3]}, curvature, vertex);
    return (imp_quad){u[0], u[1], v[2], v[3]};
}

IMP_QUAD_INLINE vec3 shape_lowest(const shape *z, vec3 n, bool bends)
{
    const imp_quad s = shape_bottom(z, n, bends), way = (imp_quad){n.x[0], n.x[1], n.x[2], n.x[2]};
    imp_quad x = z->centre + imp_quad_pick(way > imp_quad_all(0), -z->slack, z->slack);
    for (int k = 0; k < 2; ++k) {
        const imp_quad u = imp_quad_all(s[k]), v = imp_quad_all(s[2 + k]);
        x += (z->bu[k] + z->quu[k] * u + z->quv[k] * v) * u + (z->bv[k] + z->qvv[k] * v) * v;
    }
    return (vec3){{x[0], x[1], x[2]}};
}

/* --- The search ------------------------------------------------------------------------------- */

IMP_QUAD_INLINE vec3 lowest_curved(const void *set, vec3 n) { return shape_lowest(set, n, true); }

IMP_QUAD_INLINE vec3 lowest_bilinear(const void *set, vec3 n)
{
    return shape_lowest(set, n, false);
}

IMP_QUAD_INLINE bool search(const difference *r, double w, vec3 *axis, bool bends)
{
    const shape z = shape_at(r, w, bends);
    return bends ? gjk_search(lowest_curved, &z, r->share, axis)
                 : gjk_search(lowest_bilinear, &z, r->share, axis);
}

IMP_QUAD_WIDE static bool search_wide(const difference *r, double w, vec3 *axis)
{
    return search(r, w, axis, true);
}

IMP_QUAD_WIDE static bool search_bilinear_wide(const difference *r, double w, vec3 *axis)
{
    return search(r, w, axis, false);
}

bool gjk_axis(const difference *r, double w, vec3 *axis)
{
    if (r->squares == 0)
        return imp_quad_is_wide() ? search_bilinear_wide(r, w, axis) : search(r, w, axis, false);
    return imp_quad_is_wide() ? search_wide(r, w, axis) : search(r, w, axis, true);
}
