/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/polygon.h"

/* --- Its plane -------------------------------------------------------------------------------- */

typedef struct polygon {
    const double *point;
    const int64_t *corner;
    size_t count;
    double origin[3], size; /* its first corner; the greatest difference to that of a coordinate */
    double normal[3];       /* Newell's: twice the area, in units of size^2 */
} polygon;

/* Corner k, from the first, in units of the size. */
static void corner_at(const polygon *p, size_t k, double x[3])
{
    const double *at = p->point + 3 * p->corner[k % p->count];
    for (int i = 0; i < 3; ++i) x[i] = (at[i] - p->origin[i]) / p->size;
}

/* How much (b - a) x (c - b) points the way of the normal. */
static double turn(const polygon *p, const double a[3], const double b[3], const double c[3])
{
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += p->normal[i] * ((b[j] - a[j]) * (c[k] - b[k]) - (b[k] - a[k]) * (c[j] - b[j]));
    }
    return sum;
}

static polygon measure(const double *point, const int64_t *corner, size_t count)
{
    polygon p = {.point = point, .corner = corner, .count = count};
    memcpy(p.origin, point + 3 * corner[0], sizeof p.origin);
    for (size_t k = 1; k < count; ++k)
        for (int i = 0; i < 3; ++i) {
            const double off = fabs(point[3 * corner[k] + i] - p.origin[i]);
            if (off > p.size) p.size = off;
        }
    for (size_t k = 0; k < count && p.size > 0; ++k) {
        double a[3], b[3];
        corner_at(&p, k, a);
        corner_at(&p, k + 1, b);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            p.normal[i] += a[j] * b[l] - a[l] * b[j];
        }
    }
    return p;
}

static bool has_normal(const polygon *p)
{
    return p->normal[0] != 0 || p->normal[1] != 0 || p->normal[2] != 0;
}

/* Part of its size by which a corner may be off the plane, and of its area that may be turned
 * over. */
#define FLATNESS 1e-3

static bool is_plane(const polygon *p)
{
    const double *n = p->normal;
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (size_t k = 1; k < p->count; ++k) {
        double x[3];
        corner_at(p, k, x);
        if (fabs(n[0] * x[0] + n[1] * x[1] + n[2] * x[2]) > FLATNESS * length) return false;
    }
    return true;
}

/* No corner turns back, nor does a triangle of the fan, as it would where the polygon winds
 * twice. */
static bool is_convex(const polygon *p)
{
    const double *n = p->normal, origin[3] = {0, 0, 0};
    const double least = -FLATNESS * (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (size_t k = 0; k < p->count; ++k) {
        double a[3], b[3], c[3];
        corner_at(p, k, a);
        corner_at(p, k + 1, b);
        corner_at(p, k + 2, c);
        if (turn(p, a, b, c) < least || turn(p, origin, a, b) < least) return false;
    }
    return true;
}

/* Corners that all lie on one line have no plane; else a normal of 0 tells a polygon whose parts
 * cancel, as those of an eight do. */
static bool is_on_line(const polygon *p)
{
    double along[3] = {0, 0, 0};
    for (size_t k = 1; k < p->count; ++k) {
        double x[3];
        corner_at(p, k, x);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, l = (i + 2) % 3;
            if (along[j] * x[l] != along[l] * x[j]) return false;
        }
        if (along[0] == 0 && along[1] == 0 && along[2] == 0) memcpy(along, x, sizeof along);
    }
    return true;
}

bool polygon_is_fan(const double *point, const int64_t *corner, size_t count)
{
    const polygon p = measure(point, corner, count);
    if (p.size == 0) return true;
    return has_normal(&p) ? is_plane(&p) && is_convex(&p) : is_on_line(&p);
}

/* --- Seen along its normal -------------------------------------------------------------------- */

typedef struct flat {
    size_t count;
    double (*at)[2]; /* the corners, seen from where the polygon goes round to the left */
    uint32_t *next, *previous;
} flat;

static void flat_clear(flat *f)
{
    free(f->at);
    free(f->next);
    free(f->previous);
}

/* Leaves out the coordinate that the normal is longest in. False: no memory. */
static bool flatten(const polygon *p, flat *f)
{
    const double *n = p->normal;
    int axis = fabs(n[0]) > fabs(n[1]) ? 0 : 1;
    if (fabs(n[2]) >= fabs(n[axis])) axis = 2;
    const int x = (axis + (n[axis] < 0 ? 2 : 1)) % 3, y = 3 - axis - x;
    *f = (flat){.count = p->count,
                .at = malloc(p->count * sizeof *f->at),
                .next = malloc(p->count * sizeof *f->next),
                .previous = malloc(p->count * sizeof *f->previous)};
    if (f->at == NULL || f->next == NULL || f->previous == NULL) return false;
    for (size_t k = 0; k < p->count; ++k) {
        double at[3];
        corner_at(p, k, at);
        f->at[k][0] = at[x];
        f->at[k][1] = at[y];
        f->next[k] = (uint32_t)((k + 1) % p->count);
        f->previous[k] = (uint32_t)((k + p->count - 1) % p->count);
    }
    return true;
}

/* Twice the area of a triangle of corners; greater than 0 if it goes round to the left. */
static double area(const flat *f, size_t a, size_t b, size_t c)
{
    const double *p = f->at[a], *q = f->at[b], *r = f->at[c];
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/* --- Sides that cross ------------------------------------------------------------------------- */

static bool are_apart(double x, double y) { return (x > 0 && y < 0) || (x < 0 && y > 0); }

/* Whether the sides from a and from b cross, and do not only touch. */
static bool sides_cross(const flat *f, size_t a, size_t b)
{
    const size_t a1 = (a + 1) % f->count, b1 = (b + 1) % f->count;
    return are_apart(area(f, a, a1, b), area(f, a, a1, b1)) &&
           are_apart(area(f, b, b1, a), area(f, b, b1, a1));
}

static bool crosses_itself(const flat *f)
{
    for (size_t a = 0; a < f->count; ++a)
        for (size_t b = a + 1; b < f->count; ++b)
            if (sides_cross(f, a, b)) return true;
    return false;
}

/* --- Ears ------------------------------------------------------------------------------------- */

static bool is_same_place(const flat *f, size_t a, size_t b)
{
    return f->at[a][0] == f->at[b][0] && f->at[a][1] == f->at[b][1];
}

/* Whether corner k is in the triangle at ear b, its sides included, but at none of its corners: a
 * polygon around a hole passes some points twice. */
static bool is_in(const flat *f, size_t k, size_t b)
{
    const size_t a = f->previous[b], c = f->next[b];
    if (is_same_place(f, k, a) || is_same_place(f, k, b) || is_same_place(f, k, c)) return false;
    return area(f, a, b, k) >= 0 && area(f, b, c, k) >= 0 && area(f, c, a, k) >= 0;
}

/* A corner on the line of its neighbours is an ear without area. */
static bool is_ear(const flat *f, size_t b)
{
    const size_t a = f->previous[b], c = f->next[b];
    const double twice = area(f, a, b, c);
    if (!(twice > 0)) return twice == 0;
    for (size_t k = f->next[c]; k != a; k = f->next[k])
        if (is_in(f, k, b)) return false;
    return true;
}

/* False: no ear is left before all is cut. */
static bool cut_ears(flat *f, uint32_t *cut)
{
    size_t at = 0;
    for (size_t left = f->count; left >= 3; --left) {
        size_t tried = 0;
        while (left > 3 && tried < left && !is_ear(f, at)) at = f->next[at], ++tried;
        if (tried == left) return false;
        const uint32_t a = f->previous[at], c = f->next[at];
        *cut++ = a, *cut++ = (uint32_t)at, *cut++ = c;
        f->next[a] = c;
        f->previous[c] = a;
        at = f->next[c]; /* passes one by, so that triangles do not all meet in one corner */
    }
    return true;
}

imp_status polygon_cut(const double *point, const int64_t *corner, size_t count, uint32_t *cut,
                       bool *is_simple)
{
    const polygon p = measure(point, corner, count);
    flat f;
    const bool done = flatten(&p, &f);
    *is_simple = done && has_normal(&p) && !crosses_itself(&f) && cut_ears(&f, cut);
    flat_clear(&f);
    return done ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
}
