/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/triangles.h"

#include <stdarg.h>

#include "plugins/mesh/polygon.h"

void triangles_clear(triangles *t)
{
    free(t->point);
    free(t->corner);
    free(t->first);
    *t = (triangles){0};
}

void triangles_empty(triangles *t)
{
    const triangles kept = *t;
    *t = (triangles){.point = kept.point,
                     .point_capacity = kept.point_capacity,
                     .corner = kept.corner,
                     .capacity = kept.capacity,
                     .keeps_faces = kept.keeps_faces,
                     .first = kept.first,
                     .first_capacity = kept.first_capacity};
}

void triangles_fit(triangles *t)
{
    if (t->keeps_faces || t->count == 0) return;
    uint32_t *fitted = realloc(t->corner, 3 * t->count * sizeof *fitted);
    if (fitted == NULL) return;
    t->corner = fitted;
    t->capacity = t->count;
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

imp_status triangles_refuse_byte(triangles_fault *fault, size_t byte, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    fault->line = 0;
    fault->byte = byte + 1;
    return IMP_STATUS_PARAMETER;
}

bool triangles_may_take(const triangles *t, size_t more)
{
    const size_t corners = t->keeps_faces ? t->count + t->corner_count : 3 * t->count;
    return t->why == NULL ||
           imp_goes_on(t->why, t->held + more + 3 * t->point_count * sizeof *t->point +
                                   corners * sizeof *t->corner);
}

/* Asks whether to go on at the first of every few items. */
static bool goes_on_at(const triangles *t, size_t item)
{
    enum { ITEMS = 1024 };
    return item % ITEMS != 0 || triangles_may_take(t, 0);
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
    if (!goes_on_at(t, t->point_count)) return IMP_STATUS_INTERNAL;
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
    if (!goes_on_at(t, t->count)) return IMP_STATUS_INTERNAL;
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
    if (!goes_on_at(t, t->count)) return IMP_STATUS_INTERNAL;
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

static imp_status add_fan(triangles *t, const int64_t *corner, size_t count, size_t line,
                          triangles_fault *fault)
{
    imp_status status = IMP_STATUS_OK;
    for (size_t k = 2; k < count && status == IMP_STATUS_OK; ++k)
        status = add_triangle(t, (uint32_t)corner[0], (uint32_t)corner[k - 1], (uint32_t)corner[k],
                              line, fault);
    return status;
}

/* A polygon that a fan does not cover, cut by its ears. */
static imp_status add_cut(triangles *t, const int64_t *corner, size_t count, size_t line,
                          triangles_fault *fault)
{
    if (count > POLYGON_CUT_MAX)
        return triangles_refuse(fault, line,
                                "face %zu is not plane and convex and has %zu corners, may have "
                                "%d; divide it",
                                t->faces, count, POLYGON_CUT_MAX);
    uint32_t *cut = malloc(3 * (count - 2) * sizeof *cut);
    if (cut == NULL) return IMP_STATUS_INTERNAL;
    bool is_simple = false;
    imp_status status = polygon_cut(t->point, corner, count, cut, &is_simple);
    if (status == IMP_STATUS_OK && !is_simple)
        status = triangles_refuse(fault, line,
                                  "face %zu of %zu corners crosses itself; divide it into "
                                  "triangles",
                                  t->faces, count);
    for (size_t k = 0; k < count - 2 && status == IMP_STATUS_OK; ++k)
        status = add_triangle(t, (uint32_t)corner[cut[3 * k]], (uint32_t)corner[cut[3 * k + 1]],
                              (uint32_t)corner[cut[3 * k + 2]], line, fault);
    free(cut);
    if (status == IMP_STATUS_OK) triangles_note(&t->cut, line);
    return status;
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
    const imp_status status = count == 3 || polygon_is_fan(t->point, corner, count)
                                  ? add_fan(t, corner, count, line, fault)
                                  : add_cut(t, corner, count, line, fault);
    t->faces += 1;
    return status;
}

/* --- Notes ------------------------------------------------------------------------------------ */

void triangles_note(triangles_count *count, size_t line)
{
    if (count->count++ == 0) count->line = line;
}

/* Whether the corners lie on a line, or are one point. */
static bool is_thin(const double *a, const double *b, const double *c)
{
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if ((b[j] - a[j]) * (c[k] - a[k]) != (b[k] - a[k]) * (c[j] - a[j])) return false;
    }
    return true;
}

static size_t count_thin(const triangles *t)
{
    size_t count = 0;
    for (size_t k = 0; k < t->count && !t->keeps_faces; ++k) {
        const uint32_t *corner = t->corner + 3 * k;
        count += is_thin(t->point + 3 * (size_t)corner[0], t->point + 3 * (size_t)corner[1],
                         t->point + 3 * (size_t)corner[2]);
    }
    return count;
}

/* Appends "; TEXT: 3, the first in line 7". */
static void tell(char *text, size_t size, const triangles_count *count, const char *what)
{
    const size_t used = strlen(text);
    char where[48] = "";
    if (count->count == 0) return;
    if (count->line > 0) snprintf(where, sizeof where, ", the first in line %zu", count->line);
    snprintf(text + used, size - used, "%s%s: %zu%s", used > 0 ? "; " : "", what, count->count,
             where);
}

size_t triangles_tell(const triangles *t, char *text, size_t size)
{
    const triangles_count thin = {.count = count_thin(t)};
    text[0] = '\0';
    tell(text, size, &t->left_out, "statements that are no faces, left out");
    tell(text, size, &t->cut, "faces not plane and convex, cut into triangles");
    tell(text, size, &thin, "triangles without area, taken as segments");
    return t->left_out.count + t->cut.count + thin.count;
}
