/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "nearest_axis.h"

#include "lanes.h"

/* --- The point that lies lowest along a direction ----------------------------------------- */

/* B - A at a moment: centre, forms of B (0) and of -A (1), and the slack's box. x, y, z and 0 in
 * lanes; and once more coordinate by coordinate, as (u of B, u of -A, v of B, v of -A). */
typedef struct shape {
    lanes centre, slack;
    lanes bu[2], bv[2], quu[2], quv[2], qvv[2];
    lanes slope[3], bend[3], twist[3];
} shape;

LANES_INLINE void shape_take(shape *z, int k, const slice *f, double w, lanes sign)
{
    const lanes at = lanes_all(w);
    z->bu[k] = sign * (lanes_load(f->bu) + at * lanes_load(f->quw));
    z->bv[k] = sign * (lanes_load(f->bv) + at * lanes_load(f->qvw));
    z->quu[k] = sign * lanes_load(f->quu);
    z->quv[k] = sign * lanes_load(f->quv);
    z->qvv[k] = sign * lanes_load(f->qvv);
}

LANES_INLINE shape shape_at(const relative *r, double w)
{
    shape z;
    z.centre = lanes_load(r->delta) + lanes_all(w) * lanes_load(r->drift);
    z.slack = lanes_load(r->slack);
    shape_take(&z, 0, &r->b, w, lanes_all(1));
    shape_take(&z, 1, &r->a, w, lanes_all(-1));
    for (int i = 0; i < 3; ++i) {
        z.slope[i] = (lanes){z.bu[0][i], z.bu[1][i], z.bv[0][i], z.bv[1][i]};
        z.bend[i] = (lanes){z.quu[0][i], z.quu[1][i], z.qvv[0][i], z.qvv[1][i]};
        z.twist[i] = (lanes){z.quv[0][i], z.quv[1][i], z.quv[0][i], z.quv[1][i]};
    }
    return z;
}

LANES_INLINE lanes along(vec3 n, const lanes x[3])
{
    return x[0] * lanes_all(n.x[0]) + x[1] * lanes_all(n.x[1]) + x[2] * lanes_all(n.x[2]);
}

/* Where b s + q s^2 is least over [-1, 1]; `vertex` is -1 / 2q. */
LANES_INLINE lanes least_at(lanes b, lanes q, lanes vertex)
{
    const lanes one = lanes_all(1), end = lanes_pick(b > lanes_all(0), -one, one);
    const lanes inside = lanes_max(lanes_min(b * vertex, one), -one);
    return lanes_pick(q > lanes_all(0x1p-1000), inside, end);
}

/* Parameters (s_u of B, of -A, s_v of B, of -A) where both forms are least along n, about: u and v
 * in turn. */
LANES_INLINE lanes shape_bottom(const shape *z, vec3 n)
{
    const lanes slope = along(n, z->slope), bend = along(n, z->bend), twist = along(n, z->twist);
    const lanes vertex = lanes_all(-0.5) / bend;
    const lanes s = least_at(slope, bend, vertex);
    const lanes v = least_at(slope + twist * (lanes){s[2], s[3], s[0], s[1]}, bend, vertex);
    const lanes u = least_at(slope + twist * (lanes){v[2], v[3], v[2], v[3]}, bend, vertex);
    return (lanes){u[0], u[1], v[2], v[3]};
}

LANES_INLINE vec3 shape_lowest(const shape *z, vec3 n)
{
    const lanes s = shape_bottom(z, n), way = (lanes){n.x[0], n.x[1], n.x[2], n.x[2]};
    lanes x = z->centre + lanes_pick(way > lanes_all(0), -z->slack, z->slack);
    for (int k = 0; k < 2; ++k) {
        const lanes u = lanes_all(s[k]), v = lanes_all(s[2 + k]);
        x += (z->bu[k] + z->quu[k] * u + z->quv[k] * v) * u + (z->bv[k] + z->qvv[k] * v) * v;
    }
    return (vec3){{x[0], x[1], x[2]}};
}

/* --- The point of a simplex that is nearest to the origin ---------------------------------- */

/* A point, segment or triangle, and its point that is nearest, which lies inside it. */
typedef struct simplex {
    int count;
    vec3 p[3];
    vec3 nearest;
    double square; /* of its distance */
} simplex;

LANES_INLINE simplex on_point(vec3 a) { return (simplex){1, {a}, a, vec3_dot(a, a)}; }

LANES_INLINE simplex on_segment(vec3 a, vec3 b)
{
    const vec3 ab = vec3_sub(b, a);
    const double t = -vec3_dot(a, ab), length2 = vec3_dot(ab, ab);
    if (!(t > 0)) return on_point(a);
    if (!(t < length2)) return on_point(b);
    const vec3 x = vec3_sub(a, vec3_scale(ab, -t / length2));
    return (simplex){2, {a, b}, x, vec3_dot(x, x)};
}

LANES_INLINE simplex nearer(simplex s, simplex t) { return t.square < s.square ? t : s; }

/* The newest point is a: of the edge bc the search has come from elsewhere. With x = a + y ab + z
 * ac, the normal equations have the determinant `all`. */
LANES_INLINE simplex on_triangle(vec3 a, vec3 b, vec3 c)
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
LANES_INLINE bool is_beyond(vec3 a, vec3 b, vec3 c, vec3 d)
{
    const vec3 n = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
    return !(vec3_dot(n, vec3_sub(d, a)) * vec3_dot(n, a) < 0);
}

/* On the faces at a that the origin is beyond; count 0: it is inside. */
LANES_INLINE simplex on_tetrahedron(vec3 a, vec3 b, vec3 c, vec3 d)
{
    simplex s = {.count = 0, .square = INFINITY};
    if (is_beyond(a, b, c, d)) s = nearer(s, on_triangle(a, b, c));
    if (is_beyond(a, c, d, b)) s = nearer(s, on_triangle(a, c, d));
    if (is_beyond(a, d, b, c)) s = nearer(s, on_triangle(a, d, b));
    return s;
}

LANES_INLINE simplex simplex_add(const simplex *s, vec3 a)
{
    if (s->count == 1) return on_segment(a, s->p[0]);
    if (s->count == 2) return on_triangle(a, s->p[0], s->p[1]);
    return on_tetrahedron(a, s->p[0], s->p[1], s->p[2]);
}

/* --- The search ------------------------------------------------------------------------------ */

enum { STEPS = 20 }; /* six are usual */

/* The gap that the axis through the nearest point shows is the lowest point's height along it; it
 * is good enough when it is 0.7 of what it can be. A NaN ends the search. */
LANES_INLINE bool search(const relative *r, double w, vec3 *axis)
{
    const shape z = shape_at(r, w);
    simplex s = on_point(shape_lowest(&z, *axis));
    for (int k = 0; k < STEPS; ++k) {
        const vec3 lowest = shape_lowest(&z, s.nearest);
        if (!(vec3_dot(s.nearest, lowest) < 0.7 * s.square)) break;
        const simplex next = simplex_add(&s, lowest);
        if (next.count == 0) return false;
        if (!(next.square < s.square)) break;
        s = next;
    }
    *axis = s.nearest;
    return true;
}

LANES_WIDE static bool search_wide(const relative *r, double w, vec3 *axis)
{
    return search(r, w, axis);
}

bool nearest_axis(const relative *r, double w, vec3 *axis)
{
    return lanes_are_wide() ? search_wide(r, w, axis) : search(r, w, axis);
}
