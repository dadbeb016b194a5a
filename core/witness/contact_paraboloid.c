/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/witness/contact_paraboloid.h"

#include <impinge/interval.h>

/* The paraboloid's curvature beyond that of a face, in parts of what the other side leaves, or of
 * the face's own where a corner touches it; and beyond that of an edge, in parts of both edges'
 * own. Half of the former costs `bench bicubic` 2 per cent of its pairs, twice as much 5. */
static const double BEYOND_FACE = 0.5, BEYOND_EDGE = 0.5;

/* A symmetric form in the coordinates along two directions. */
typedef struct form {
    double xx, xy, yy;
} form;

typedef enum place { CORNER, EDGE, FACE } place;

static place place_of(const contact_side *s) { return (place)(s->is_free[0] + s->is_free[1]); }

static vec3 part_of(const contact_side *s, int part)
{
    const imp_quad x = s->of->by[part];
    return (vec3){{x[0], x[1], x[2]}};
}

/* The way along which a point on an edge can move. */
static vec3 way_of(const contact_side *s) { return part_of(s, s->is_free[0] ? NET_U : NET_V); }

static vec3 unit(vec3 x) { return vec3_scale(x, 1 / vec3_norm(x)); }

static vec3 normal_of(const contact_side sides[2], vec3 apart)
{
    vec3 n = apart;
    if (place_of(&sides[0]) == EDGE && place_of(&sides[1]) == EDGE)
        n = vec3_cross(way_of(&sides[0]), way_of(&sides[1]));
    for (int side = 1; side >= 0; --side)
        if (place_of(&sides[side]) == FACE)
            n = vec3_cross(part_of(&sides[side], NET_U), part_of(&sides[side], NET_V));
    return unit(vec3_dot(n, apart) < 0 ? vec3_scale(n, -1) : n);
}

/* Fills two directions across the normal, the first along an edge if there is one. */
static void across(const contact_side sides[2], vec3 n, vec3 e[2])
{
    const int edge = place_of(&sides[0]) == EDGE ? 0 : 1;
    const vec3 way =
        place_of(&sides[edge]) == EDGE ? way_of(&sides[edge]) : part_of(&sides[0], NET_U);
    e[0] = unit(vec3_sub(way, vec3_scale(n, vec3_dot(n, way))));
    e[1] = vec3_cross(n, e[0]);
}

/* --- Curvature along the normal --------------------------------------------------------------- */

static form face_form(const contact_side *s, vec3 n, const vec3 e[2])
{
    const vec3 u = part_of(s, NET_U), v = part_of(s, NET_V);
    const double a = vec3_dot(u, e[0]), b = vec3_dot(v, e[0]), c = vec3_dot(u, e[1]),
                 d = vec3_dot(v, e[1]), over = 1 / (a * d - b * c);
    const double uu = vec3_dot(n, part_of(s, NET_UU)), uv = vec3_dot(n, part_of(s, NET_UV)),
                 vv = vec3_dot(n, part_of(s, NET_VV));
    const double ux = d * over, uy = -b * over, vx = -c * over, vy = a * over;
    return (form){uu * ux * ux + 2 * uv * ux * vx + vv * vx * vx,
                  uu * ux * uy + uv * (ux * vy + uy * vx) + vv * vx * vy,
                  uu * uy * uy + 2 * uv * uy * vy + vv * vy * vy};
}

/* An edge: its direction in the plane, and its curvature. */
typedef struct edge {
    double x, y, bend;
} edge;

static edge edge_of(const contact_side *s, vec3 n, const vec3 e[2])
{
    const vec3 way = way_of(s);
    const double x = vec3_dot(way, e[0]), y = vec3_dot(way, e[1]), square = x * x + y * y;
    const double bend = vec3_dot(n, part_of(s, s->is_free[0] ? NET_UU : NET_VV));
    return (edge){x / sqrt(square), y / sqrt(square), bend / square};
}

static double form_along(const form *q, const edge *t)
{
    return q->xx * t->x * t->x + 2 * q->xy * t->x * t->y + q->yy * t->y * t->y;
}

/* Whether the surface bends away from the plane: A down, B up. */
static bool bends_away(const contact_side *s, int side, vec3 n, const vec3 e[2])
{
    const double sign = side == 0 ? -1 : 1;
    if (place_of(s) == CORNER) return true;
    if (place_of(s) == EDGE) return sign * edge_of(s, n, e).bend > 0;
    const form q = face_form(s, n, e);
    return sign * q.xx > 0 && q.xx * q.yy > q.xy * q.xy;
}

/* --- The paraboloid's curvature --------------------------------------------------------------- */

/* A form's axes: along the first, turned by the angle with this cosine and sine, it is `first`,
 * across that `second`, which is no more. */
typedef struct turned {
    double c, s, first, second;
} turned;

/* With d = xx - yy, p = 2 xy and r = hypot(d, p) twice the angle has the cosine d / r and the sine
 * p / r. Of cosine and sine of the angle the larger is the root of (r + |d|) / 2 r, where nothing
 * cancels; their product is p / 2 r. Roots alone, so that the axes do not depend on the C library.
 * Squares that overflow give a NaN, which proves nothing. */
static turned axes_of(const form *q)
{
    const double d = q->xx - q->yy, p = 2 * q->xy, r = sqrt(d * d + p * p);
    double c = 1, s = 0;
    if (r > 0) {
        const double larger = sqrt((r + fabs(d)) / (2 * r)), smaller = fabs(p) / (2 * r * larger);
        c = d < 0 ? smaller : larger;
        s = copysign(d < 0 ? larger : smaller, p);
    }
    return (turned){c, s, q->xx * c * c + 2 * q->xy * c * s + q->yy * s * s,
                    q->xx * s * s - 2 * q->xy * c * s + q->yy * c * c};
}

static double size_of_form(const form *q) { return fabs(q->xx) + fabs(q->yy) + fabs(q->xy); }

/* The most that a paraboloid bends beyond the flatter face. */
static double room_beyond(const contact_side *s, const form *q)
{
    return BEYOND_FACE * size_of_form(q) +
           1 / (vec3_norm(part_of(s, NET_U)) + vec3_norm(part_of(s, NET_V)));
}

/* Half way between both, but little beyond the flatter: terms of third order grow with the
 * curvature. */
static form between_faces(const contact_side sides[2], vec3 n, const vec3 e[2])
{
    const form a = face_form(&sides[0], n, e), b = face_form(&sides[1], n, e);
    const form gap = {b.xx - a.xx, b.xy - a.xy, b.yy - a.yy};
    const int flatter = size_of_form(&b) < size_of_form(&a) ? 1 : 0;
    const form *from = flatter == 0 ? &a : &b;
    const double most = room_beyond(&sides[flatter], from), sign = flatter == 0 ? 1 : -1;
    const turned t = axes_of(&gap);
    const double x = sign * imp_smaller(0.5 * t.first, most),
                 y = sign * imp_smaller(0.5 * t.second, most);
    return (form){from->xx + x * t.c * t.c + y * t.s * t.s, from->xy + (x - y) * t.c * t.s,
                  from->yy + x * t.s * t.s + y * t.c * t.c};
}

/* Adds to the curvature of face `side` as much in all directions. */
static form beside_face(const contact_side sides[2], int side, vec3 n, const vec3 e[2])
{
    const contact_side *other = &sides[!side];
    form q = face_form(&sides[side], n, e);
    const double sign = side == 0 ? 1 : -1;
    double more = BEYOND_FACE * (fabs(q.xx) + fabs(q.yy));
    if (place_of(other) == EDGE) {
        const edge t = edge_of(other, n, e);
        more = imp_smaller(BEYOND_FACE * sign * (t.bend - form_along(&q, &t)),
                           room_beyond(&sides[side], &q));
    }
    q.xx += sign * more;
    q.yy += sign * more;
    return q;
}

/* Two edges that cross leave the curvature along each of them free: along A's it is more than that
 * edge's, along B's less. The form is a sum of squares of what vanishes along the other edge. */
static form between_edges(const contact_side sides[2], vec3 n, const vec3 e[2])
{
    const edge a = edge_of(&sides[0], n, e), b = edge_of(&sides[1], n, e);
    const double more = 0.5 * BEYOND_EDGE * (fabs(a.bend) + fabs(b.bend));
    const double over = 1 / (a.x * b.y - a.y * b.x);
    const double up = a.bend + more > 0 ? a.bend + more : 0,
                 down = b.bend - more < 0 ? b.bend - more : 0;
    const double along_a = up * over * over, along_b = down * over * over;
    return (form){along_a * b.y * b.y + along_b * a.y * a.y,
                  -along_a * b.x * b.y - along_b * a.x * a.y,
                  along_a * b.x * b.x + along_b * a.x * a.x};
}

static form beside_edge(const contact_side *s, int side, vec3 n, const vec3 e[2])
{
    const edge t = edge_of(s, n, e);
    const double bend = t.bend + (side == 0 ? BEYOND_EDGE : -BEYOND_EDGE) * fabs(t.bend);
    return (form){bend * t.x * t.x, bend * t.x * t.y, bend * t.y * t.y};
}

static form form_of(const contact_side sides[2], vec3 n, const vec3 e[2])
{
    const place a = place_of(&sides[0]), b = place_of(&sides[1]);
    if (bends_away(&sides[0], 0, n, e) && bends_away(&sides[1], 1, n, e)) return (form){0, 0, 0};
    if (a == FACE && b == FACE) return between_faces(sides, n, e);
    if (a == FACE || b == FACE) return beside_face(sides, a == FACE ? 0 : 1, n, e);
    if (a == EDGE && b == EDGE) return between_edges(sides, n, e);
    return beside_edge(&sides[a == EDGE ? 0 : 1], a == EDGE ? 0 : 1, n, e);
}

void contact_paraboloid_choose(const contact_side sides[2], vec3 apart, net_paraboloid *d)
{
    const vec3 n = normal_of(sides, apart);
    vec3 e[2];
    across(sides, n, e);
    const form q = form_of(sides, n, e);
    const turned t = axes_of(&q);
    d->normal = n;
    d->across[0] = vec3_add(vec3_scale(e[0], t.c), vec3_scale(e[1], t.s));
    d->across[1] = vec3_sub(vec3_scale(e[1], t.c), vec3_scale(e[0], t.s));
    d->bend[0] = t.first;
    d->bend[1] = t.second;
}
