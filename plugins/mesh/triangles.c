/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/triangles.h"

#include <stdarg.h>

void triangles_clear(triangles *t)
{
    free(t->point);
    free(t->corner);
    free(t->first);
    *t = (triangles){0};
}

imp_status triangles_refuse(triangles_fault *fault, size_t line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    fault->line = line;
    return IMP_STATUS_PARAMETER;
}

/* Room for three more items of that size. NULL: no memory; the old ones are still there. */
static void *reserve(void *items, size_t used, size_t *capacity, size_t size)
{
    if (items != NULL && used + 1 <= *capacity) return items;
    const size_t wanted = items == NULL ? 64 : 2 * *capacity;
    void *grown = realloc(items, 3 * size * wanted);
    if (grown != NULL) *capacity = wanted;
    return grown;
}

imp_status triangles_add_point(triangles *t, const double x[3], size_t line, triangles_fault *fault)
{
    for (int i = 0; i < 3; ++i)
        if (!(fabs(x[i]) <= TRIANGLES_FAR))
            return triangles_refuse(fault, line, "coordinate %g, must be from -1e100 to 1e100",
                                    x[i]);
    if (t->point_count >= 3 * IMP_PIECES_MAX)
        return triangles_refuse(fault, line, "more than %zu points", 3 * IMP_PIECES_MAX);
    double *grown = reserve(t->point, t->point_count, &t->point_capacity, sizeof *grown);
    if (grown == NULL) return IMP_STATUS_INTERNAL;
    t->point = grown;
    memcpy(grown + 3 * t->point_count++, x, 3 * sizeof *x);
    return IMP_STATUS_OK;
}

static imp_status add_triangle(triangles *t, uint32_t a, uint32_t b, uint32_t c, size_t line,
                               triangles_fault *fault)
{
    if (t->count >= IMP_PIECES_MAX)
        return triangles_refuse(fault, line, "more than %zu triangles; divide the mesh",
                                IMP_PIECES_MAX);
    uint32_t *grown = reserve(t->corner, t->count, &t->capacity, sizeof *grown);
    if (grown == NULL) return IMP_STATUS_INTERNAL;
    t->corner = grown;
    uint32_t *corner = grown + 3 * t->count++;
    corner[0] = a, corner[1] = b, corner[2] = c;
    return IMP_STATUS_OK;
}

/* --- Whole faces ------------------------------------------------------------------------------ */

/* Room for `more` numbers beside those in use. NULL: no memory; the old ones are still there. */
static uint32_t *room_for(uint32_t *items, size_t used, size_t more, size_t *capacity)
{
    if (items != NULL && more <= *capacity - used) return items;
    const size_t wanted = 2 * (used + more) + 64;
    uint32_t *grown = realloc(items, wanted * sizeof *grown);
    if (grown != NULL) *capacity = wanted;
    return grown;
}

static imp_status keep_face(triangles *t, const int64_t *corner, size_t count, size_t line,
                            triangles_fault *fault)
{
    if (t->count >= IMP_PIECES_MAX)
        return triangles_refuse(fault, line, "more than %zu faces; divide the mesh",
                                IMP_PIECES_MAX);
    uint32_t *first = room_for(t->first, t->count, 1, &t->first_capacity);
    if (first == NULL) return IMP_STATUS_INTERNAL;
    t->first = first;
    uint32_t *corners = room_for(t->corner, t->corner_count, count, &t->capacity);
    if (corners == NULL) return IMP_STATUS_INTERNAL;
    t->corner = corners;
    first[t->count++] = (uint32_t)t->corner_count;
    for (size_t k = 0; k < count; ++k) corners[t->corner_count++] = (uint32_t)corner[k];
    t->faces += 1;
    return IMP_STATUS_OK;
}

/* --- Polygons --------------------------------------------------------------------------------- */

typedef struct polygon {
    const triangles *of;
    const int64_t *corner;
    size_t count;
    double origin[3], size; /* its first corner; the greatest difference to that of a coordinate */
    double normal[3];       /* Newell's: twice the area, in units of size^2 */
} polygon;

/* Corner k, from the first, in units of the size. */
static void corner_at(const polygon *p, size_t k, double x[3])
{
    const double *at = p->of->point + 3 * p->corner[k % p->count];
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

static polygon measure(const triangles *t, const int64_t *corner, size_t count)
{
    polygon p = {.of = t, .corner = corner, .count = count};
    memcpy(p.origin, t->point + 3 * corner[0], sizeof p.origin);
    for (size_t k = 1; k < count; ++k)
        for (int i = 0; i < 3; ++i) {
            const double off = fabs(t->point[3 * corner[k] + i] - p.origin[i]);
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

imp_status triangles_add_face(triangles *t, const int64_t *corner, size_t count, size_t line,
                              triangles_fault *fault)
{
    if (count < 3)
        return triangles_refuse(fault, line, "a face of %zu corners, must have 3 or more", count);
    for (size_t k = 0; k < count; ++k)
        if (corner[k] < 0 || corner[k] >= (int64_t)t->point_count)
            return triangles_refuse(fault, line,
                                    "corner %zu of face %zu is point %lld of %zu (from 0)", k,
                                    t->faces, (long long)corner[k], t->point_count);
    if (t->keeps_faces) return keep_face(t, corner, count, line, fault);
    if (count > 3) {
        const polygon p = measure(t, corner, count);
        if (p.size > 0 && (!is_plane(&p) || !is_convex(&p)))
            return triangles_refuse(fault, line,
                                    "face %zu of %zu corners is not %s; divide it into triangles",
                                    t->faces, count, is_plane(&p) ? "convex" : "plane");
    }
    t->faces += 1;
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 2; k < count && status == IMP_STATUS_OK; ++k)
        status = add_triangle(t, (uint32_t)corner[0], (uint32_t)corner[k - 1], (uint32_t)corner[k],
                              line, fault);
    return status;
}
