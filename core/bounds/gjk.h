/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_GJK_H
#define CORE_BOUNDS_GJK_H

#include "core/bounds/tuning.h"
#include "core/tree/vec.h"

#include <impinge/quad.h>

/* The axis along which a convex set lies farthest from the origin: GJK
 * ====================================================================
 * The axis through the set's point that is nearest to the origin shows the widest gap of all. The
 * point is sought by the method of E. Gilbert, D. Johnson and S. Keerthi ("A fast procedure for
 * computing the distance between complex objects in three-dimensional space", 1988), stopped early.
 * The set is given by its support function. For two nodes it is the Minkowski difference B - A: of
 * their Taylor models (gjk_axis.c), of the hulls of their control nets (net_axis.c), or of a model
 * and a hull (net_model_axis.c). Nothing is proved here: those files, and fixed_axes.c, prove
 * afterwards what the axis shows. */

/* --- The nearest point of a simplex ----------------------------------------------------------- */

/* A point, segment or triangle, whose point nearest to the origin lies inside it. */
typedef struct simplex {
    int count;
    vec3 p[3];
    vec3 nearest;
    double square; /* of its distance */
} simplex;

IMP_QUAD_INLINE simplex on_point(vec3 a) { return (simplex){1, {a}, a, vec3_dot(a, a)}; }

IMP_QUAD_INLINE simplex on_segment(vec3 a, vec3 b)
{
    const vec3 ab = vec3_sub(b, a);
    const double t = -vec3_dot(a, ab), length2 = vec3_dot(ab, ab);
    if (!(t > 0)) return on_point(a);
    if (!(t < length2)) return on_point(b);
    const vec3 x = vec3_sub(a, vec3_scale(ab, -t / length2));
    return (simplex){2, {a, b}, x, vec3_dot(x, x)};
}

IMP_QUAD_INLINE simplex nearer(simplex s, simplex t) { return t.square < s.square ? t : s; }

/* The newest point is a. The edge bc belongs to the previous simplex and is not tried again. With x
 * = a + y ab + z ac, the normal equations have the determinant `all`. */
IMP_QUAD_INLINE simplex on_triangle(vec3 a, vec3 b, vec3 c)
{
    const vec3 ab = vec3_sub(b, a), ac = vec3_sub(c, a);
    const double p = -vec3_dot(ab, a), q = -vec3_dot(ac, a);
    const double bb = vec3_dot(ab, ab), bc = vec3_dot(ab, ac), cc = vec3_dot(ac, ac);
    const double y = cc * p - bc * q, z = bb * q - bc * p, all = bb * cc - bc * bc;
    if (!(y > 0 && z > 0 && y + z < all)) return nearer(on_segment(a, b), on_segment(a, c));
    const vec3 n = vec3_cross(ab, ac);
    const vec3 x = vec3_scale(n, vec3_dot(n, a) / vec3_dot(n, n));
    return (simplex){3, {a, b, c}, x, vec3_dot(x, x)};
}

/* Whether the origin and d lie on different sides of the plane through a, b and c. */
IMP_QUAD_INLINE bool is_beyond(vec3 a, vec3 b, vec3 c, vec3 d)
{
    const vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    return !(vec3_dot(n, vec3_sub(d, a)) * vec3_dot(n, a) < 0);
}

/* The nearest point on the faces at a beyond which the origin lies; count 0: the origin is
 * inside. */
IMP_QUAD_INLINE simplex on_tetrahedron(vec3 a, vec3 b, vec3 c, vec3 d)
{
    simplex s = {.count = 0, .square = INFINITY};
    if (is_beyond(a, b, c, d)) s = nearer(s, on_triangle(a, b, c));
    if (is_beyond(a, c, d, b)) s = nearer(s, on_triangle(a, c, d));
    if (is_beyond(a, d, b, c)) s = nearer(s, on_triangle(a, d, b));
    return s;
}

IMP_QUAD_INLINE simplex simplex_add(const simplex *s, vec3 a)
{
    if (s->count == 1) return on_segment(a, s->p[0]);
    if (s->count == 2) return on_triangle(a, s->p[0], s->p[1]);
    return on_tetrahedron(a, s->p[0], s->p[1], s->p[2]);
}

/* --- The search ------------------------------------------------------------------------------- */

/* A support function: returns the point of the set that lies lowest along n, or nearly. Callers
 * pass a constant, so that it is inlined. */
typedef vec3 (*gjk_support)(const void *set, vec3 n);

/* Turns `axis`, which may be any direction but 0, to one along which the set is at least `share` of
 * its distance from the origin. False: the set contains the origin; `axis` is unchanged. A NaN ends
 * the search. */
IMP_QUAD_INLINE bool gjk_search(gjk_support lowest, const void *set, double share, vec3 *axis)
{
    simplex s = on_point(lowest(set, *axis));
    for (int k = 0; k < TUNING_GJK_STEPS; ++k) {
        const vec3 low = lowest(set, s.nearest);
        if (!(vec3_dot(s.nearest, low) < share * s.square)) break;
        const simplex next = simplex_add(&s, low);
        if (next.count == 0) return false;
        if (!(next.square < s.square)) break;
        s = next;
    }
    *axis = s.nearest;
    return true;
}

#endif
