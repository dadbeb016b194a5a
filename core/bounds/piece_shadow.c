/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/bounds/piece_shadow.h"

#include <stdlib.h>

#include "core/base/rounding.h"
#include "core/base/status.h"

/* --- As the other surface sees it ------------------------------------------------------------- */

static vec3 turned(const surface_course *c, vec3 y)
{
    vec3 x;
    for (int i = 0; i < 3; ++i) x.x[i] = vec3_dot(vec3_from(c->turn[i]), y);
    return x;
}

/* Bounds |D x| / |x|, D = N^T N - 1, N the numbers of the turn. Rounding of an entry: 4 of products
 * of columns about as long as 1. */
PAD_COVERS(16, 4);
static double deviation_upper(const surface_course *c)
{
    double most = 0;
    for (int i = 0; i < 3; ++i) {
        double row = 0;
        for (int j = 0; j < 3; ++j) {
            double entry = i == j ? -1 : 0, size = fabs(entry);
            for (int k = 0; k < 3; ++k) {
                entry += c->turn[k][i] * c->turn[k][j];
                size += fabs(c->turn[k][i] * c->turn[k][j]);
            }
            row += fabs(entry) + 16 * UNIT_ROUNDOFF * size;
        }
        if (!(row <= most)) most = row;
    }
    return padded_upper(most, 16);
}

/* Lemma. Let d >= |N^T N - 1|, d < 1 / 2: the rotation U of N's polar decomposition has |N - U| <=
 * d, as each singular value is within d of 1. N (z_k + r_k e_k) = N z_k + r_k U e_k but for r_k d,
 * and U e_k is across U n, n the hoop's axis. With m = N n / |N n|, |m - U n| <= 2 d + 16 u, the
 * smallest rotation that takes U n to m moves U e_k by no more; so the point is on the circle of
 * radius r_k about N z_k across m but for r_k (3 d + 16 u). N z_k + shift has 4 roundings of its
 * parts. */
PAD_COVERS(16, 6);
piece_cell piece_shadow_seen(const piece_course *of, const piece_cell *cell)
{
    const surface_course *c = &of->course;
    piece_cell z = *cell;
    double most = 0;
    for (int k = 0; k < 4; ++k) {
        z.corner[k] = vec3_add(turned(c, cell->corner[k]), vec3_from(c->shift));
        if (cell->radius[k] > most) most = cell->radius[k];
    }
    if (!cell->is_hoop) return z;
    const double d = deviation_upper(c);
    const vec3 axis = turned(c, cell->axis);
    z.axis = vec3_scale(axis, 1 / vec3_norm(axis));
    z.slack =
        d < 0.5 ? padded_upper(cell->slack + most * (3 * d + 16 * UNIT_ROUNDOFF), 16) : INFINITY;
    return z;
}

/* --- Its places ------------------------------------------------------------------------------- */

static int along_line(const void *x, const void *y)
{
    const shadow_point *p = x, *q = y;
    for (int i = 0; i < 2; ++i)
        if (p->p.x[i] != q->p.x[i]) return p->p.x[i] < q->p.x[i] ? -1 : 1;
    return p->cell < q->cell ? -1 : p->cell > q->cell;
}

/* Whether the middle one of three points, ordered along the line, is surely not above the others'
 * chord. Rounding: 2 of each product and 2 of its factors, 1 of the difference. Each product loses
 * up to 2^-1075 more where it underflows. */
PAD_COVERS(16, 2 * 2 + 2 + 1);
#define PRODUCTS_UNDERFLOW 0x1p-1070
static bool is_below(vec3 before, vec3 middle, vec3 after)
{
    if (middle.x[1] <= before.x[1] && middle.x[1] <= after.x[1]) return true;
    const vec3 u = vec3_sub(middle, before), v = vec3_sub(after, before);
    const double rise = u.x[1] * v.x[0], chord = u.x[0] * v.x[1];
    return chord - rise >= 16 * UNIT_ROUNDOFF * (fabs(rise) + fabs(chord)) + PRODUCTS_UNDERFLOW;
}

/* Keeps the upper hull, but for points in doubt. Lemma. w.p with w[1] <= 0 is no less at a point
 * than at the better of two others on whose chord, or below, it lies, or at one straight above. */
static void keep_outer(piece_shadow *s)
{
    size_t kept = 0;
    qsort(s->of, s->count, sizeof *s->of, along_line);
    for (size_t k = 0; k < s->count; ++k) {
        const shadow_point next = s->of[k];
        if (kept > 0 && s->of[kept - 1].p.x[0] == next.p.x[0]) kept -= 1;
        while (kept > 1 && is_below(s->of[kept - 2].p, s->of[kept - 1].p, next.p)) kept -= 1;
        s->of[kept++] = next;
    }
    s->count = kept;
}

/* Adds the places of a corner's circle. Lemma. Let z = x + r e, with e across m, r and x of a
 * corner, and s = |m x k|. Then |k.e| <= s, so that z has a place within r s of that of x along the
 * line, and at most r more beside it. What is within `slack` of z has places no farther than
 * `slack` from those of z. So w.p of it, with w[1] <= 0, is no less than at one of two points, at
 * both ends of these places along the line, and at their greatest beside it. Rounding: s 16, its
 * product 1, sums 4. */
static void add_places(piece_shadow *s, const piece_cell *z, int corner, size_t cell)
{
    const vec3 axis = vec3_from(s->course->axis);
    const vec3 from = vec3_sub(z->corner[corner], vec3_from(s->course->center));
    const double radius = z->radius[corner], sine = vec3_norm(vec3_cross(z->axis, axis));
    const double p = vec3_dot(from, axis), q = vec3_norm(vec3_cross(from, axis));
    const double more = radius * sine + z->slack;
    s->of[s->count++] = (shadow_point){.p = {{p - more, q + radius + z->slack, 0}}, .cell = cell};
    if (more > 0)
        s->of[s->count++] =
            (shadow_point){.p = {{p + more, q + radius + z->slack, 0}}, .cell = cell};
}

imp_code piece_shadow_take(const piece_course *of, piece_shadow *s, imp_error *error)
{
    const size_t cells = of->other->count;
    *s = (piece_shadow){.course = &of->course, .store = of->other->store};
    s->of = arena_store_room(s->store, (of->course.spins ? 8 : 4) * cells * sizeof *s->of);
    if (s->of == NULL) return error_set_memory(error);
    for (size_t k = 0; k < cells; ++k) {
        const piece_cell z = piece_shadow_seen(of, &of->other->of[k]);
        for (int j = 0; j < 4; ++j) {
            const double size = vec3_norm(z.corner[j]) + z.radius[j] + z.slack;
            if (size > s->reach) s->reach = size;
            if (of->course.spins)
                add_places(s, &z, j, k);
            else
                s->of[s->count++] = (shadow_point){z.corner[j], z.axis, z.radius[j], z.slack, k};
        }
    }
    if (of->course.spins) keep_outer(s);
    return IMP_SUCCESS;
}

void piece_shadow_clear(piece_shadow *s)
{
    arena_store_free_room(s->store, s->of);
    s->of = NULL;
}

/* --- Along one direction ---------------------------------------------------------------------- */

static vec3 weights_of(const surface_course *c, vec3 n)
{
    if (!c->spins) return n;
    const vec3 axis = vec3_from(c->axis);
    return (vec3){{vec3_dot(n, axis), -vec3_norm(vec3_cross(n, axis)), 0}};
}

/* Where the course does not spin, n.(x + r e) >= n.x - r |n x m| for each e across m. */
static double height_of(const shadow_point *x, vec3 n, vec3 w)
{
    const double here = vec3_dot(w, x->p) - x->slack;
    return x->radius > 0 ? here - x->radius * vec3_norm(vec3_cross(n, x->axis)) : here;
}

double piece_shadow_least(const piece_shadow *s, vec3 n, size_t *cell)
{
    const vec3 w = weights_of(s->course, n);
    double least = INFINITY;
    for (size_t k = 0; k < s->count; ++k) {
        const double here = height_of(&s->of[k], n, w);
        if (!(here >= least)) least = here, *cell = s->of[k].cell;
    }
    return least;
}

vec3 piece_shadow_lowest(const piece_shadow *s, vec3 n)
{
    const surface_course *c = s->course;
    const vec3 w = weights_of(c, n), axis = vec3_from(c->axis);
    const shadow_point *low = s->of;
    double least = INFINITY;
    for (size_t k = 0; k < s->count; ++k) {
        const double here = height_of(&s->of[k], n, w);
        if (here < least) least = here, low = &s->of[k];
    }
    if (!c->spins)
        return low->radius > 0 ? piece_circle_lowest(low->p, low->axis, low->radius, n) : low->p;
    const vec3 at = vec3_add(vec3_from(c->center), vec3_scale(axis, low->p.x[0]));
    return piece_circle_lowest(at, axis, low->p.x[1], n);
}
