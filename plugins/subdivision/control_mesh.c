/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/control_build.h"

void control_clear(control_mesh *m)
{
    free(m->point);
    free(m->velocity);
    free(m->first);
    free(m->corner);
    free(m->face);
    free(m->twin);
    free(m->fan);
    *m = (control_mesh){0};
}

void control_settle(control_mesh *m)
{
    free(m->fan);
    m->fan = NULL;
}

/* --- Half-edges by the point where they begin ------------------------------------------------- */

/* The half-edges that begin at point p are order[from[p]] to order[from[p + 1] - 1]. */
typedef struct outgoing {
    uint32_t *from, *order;
} outgoing;

static void outgoing_clear(outgoing *o)
{
    free(o->from);
    free(o->order);
}

static bool outgoing_make(const control_mesh *m, outgoing *o)
{
    o->from = calloc(m->point_count + 2, sizeof *o->from);
    o->order = malloc(m->corner_count * sizeof *o->order);
    if (o->from == NULL || o->order == NULL) return false;
    for (size_t h = 0; h < m->corner_count; ++h) o->from[m->corner[h] + 2] += 1;
    for (size_t p = 0; p < m->point_count; ++p) o->from[p + 2] += o->from[p + 1];
    for (size_t h = 0; h < m->corner_count; ++h)
        o->order[o->from[m->corner[h] + 1]++] = (uint32_t)h;
    return true;
}

/* The half-edge from a to b, other than `but`; CONTROL_NONE: there is none. */
static uint32_t outgoing_find(const control_mesh *m, const outgoing *o, uint32_t a, uint32_t b,
                              uint32_t but)
{
    for (uint32_t k = o->from[a]; k < o->from[a + 1]; ++k)
        if (o->order[k] != but && control_end(m, o->order[k]) == b) return o->order[k];
    return CONTROL_NONE;
}

/* --- What may be wrong with faces ------------------------------------------------------------- */

/* A point that a face has twice; CONTROL_NONE: none. */
static uint32_t repeated_corner(const control_mesh *m, uint32_t f)
{
    for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h)
        for (uint32_t g = h + 1; g < m->first[f + 1]; ++g)
            if (m->corner[g] == m->corner[h]) return m->corner[h];
    return CONTROL_NONE;
}

static imp_status check_faces(const control_mesh *m, triangles_fault *fault)
{
    for (uint32_t f = 0; f < m->face_count; ++f) {
        const uint32_t corners = m->first[f + 1] - m->first[f];
        if (corners > CONTROL_VALENCE_MAX)
            return triangles_refuse(fault, 0, "face %u has %u corners, may have %d; divide it", f,
                                    corners, CONTROL_VALENCE_MAX);
        if (m->loop != NULL && corners != 3)
            return triangles_refuse(
                fault, 0,
                "face %u has %u corners, Loop's scheme takes triangles; divide it "
                "into such, or take scheme=catmull-clark",
                f, corners);
        const uint32_t twice = repeated_corner(m, f);
        if (twice != CONTROL_NONE)
            return triangles_refuse(fault, 0,
                                    "face %u has point %u twice; leave one out, or divide the face",
                                    f, twice);
    }
    return IMP_STATUS_OK;
}

static imp_status check_valences(const control_mesh *m, const outgoing *o, triangles_fault *fault)
{
    for (uint32_t p = 0; p < m->point_count; ++p)
        if (o->from[p + 1] - o->from[p] > CONTROL_VALENCE_MAX)
            return triangles_refuse(fault, 0,
                                    "%u faces at point %u (face %u is one), may be %d; divide "
                                    "the mesh there",
                                    o->from[p + 1] - o->from[p], p, m->face[o->order[o->from[p]]],
                                    CONTROL_VALENCE_MAX);
    return IMP_STATUS_OK;
}

static imp_status check_edges(const control_mesh *m, const outgoing *o, triangles_fault *fault)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        const uint32_t a = m->corner[h], b = control_end(m, h);
        const uint32_t other = outgoing_find(m, o, a, b, h);
        if (other != CONTROL_NONE)
            return triangles_refuse(
                fault, 0,
                "faces %u and %u both go from point %u to point %u; turn one of "
                "them round, or separate them where more than two meet",
                m->face[h], m->face[other], a, b);
    }
    return IMP_STATUS_OK;
}

/* --- Twins and fans --------------------------------------------------------------------------- */

static void set_twins(control_mesh *m, const outgoing *o)
{
    for (uint32_t h = 0; h < m->corner_count; ++h)
        m->twin[h] = outgoing_find(m, o, control_end(m, h), m->corner[h], CONTROL_NONE);
}

/* The fan that half-edge h of the point is in. */
static control_point fan_of(const control_mesh *m, uint32_t h)
{
    control_point p = {.start = h, .faces = 1, .is_border = false};
    uint32_t g = control_turn_right(m, h);
    while (g != CONTROL_NONE && g != h) p.start = g, g = control_turn_right(m, g);
    p.is_border = g == CONTROL_NONE;
    if (!p.is_border) p.start = h;
    for (g = control_turn_left(m, p.start); g != CONTROL_NONE && g != p.start;
         g = control_turn_left(m, g))
        p.faces += 1;
    return p;
}

static void set_fans(control_mesh *m, const outgoing *o)
{
    for (uint32_t p = 0; p < m->point_count; ++p) {
        const bool is_used = o->from[p] < o->from[p + 1];
        m->fan[p] =
            is_used ? fan_of(m, o->order[o->from[p]]) : (control_point){CONTROL_NONE, 0, false};
    }
}

static bool is_in_fan(const control_mesh *m, const control_point *p, uint32_t h)
{
    uint32_t g = p->start;
    for (uint16_t k = 0; k < p->faces; ++k, g = control_turn_left(m, g))
        if (g == h) return true;
    return false;
}

static imp_status check_fans(const control_mesh *m, const outgoing *o, triangles_fault *fault)
{
    for (uint32_t p = 0; p < m->point_count; ++p) {
        if (o->from[p + 1] - o->from[p] == m->fan[p].faces) continue;
        uint32_t k = o->from[p];
        while (is_in_fan(m, &m->fan[p], o->order[k])) ++k;
        const uint32_t f = m->face[m->fan[p].start], other = m->face[o->order[k]];
        return triangles_refuse(
            fault, 0,
            "faces %u and %u meet at point %u alone, in two fans; give one of the "
            "fans a point of its own",
            f < other ? f : other, f < other ? other : f, p);
    }
    return IMP_STATUS_OK;
}

/* Two triangles between the same points have all edges in common, and so would all that a step
 * makes of them: no points tell which. Elsewhere two faces have one edge in common at most. */
static imp_status check_pairs(const control_mesh *m, triangles_fault *fault)
{
    for (uint32_t p = 0; m->loop != NULL && p < m->point_count; ++p) {
        const control_point *at = &m->fan[p];
        if (at->start == CONTROL_NONE || at->is_border || at->faces > 2) continue;
        return triangles_refuse(
            fault, 0,
            "faces %u and %u are all around point %u, Loop's scheme takes three or "
            "more; leave one out, or divide them",
            m->face[at->start], m->face[control_turn_left(m, at->start)], p);
    }
    return IMP_STATUS_OK;
}

/* --- Building --------------------------------------------------------------------------------- */

static bool make_room(control_mesh *m)
{
    m->face = malloc(m->corner_count * sizeof *m->face);
    m->twin = malloc(m->corner_count * sizeof *m->twin);
    m->fan = malloc(m->point_count * sizeof *m->fan);
    if (m->face == NULL || m->twin == NULL || m->fan == NULL) return false;
    for (uint32_t f = 0; f < m->face_count; ++f)
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h) m->face[h] = f;
    return true;
}

imp_status control_connect(control_mesh *m, triangles_fault *fault)
{
    outgoing o = {NULL, NULL};
    imp_status status = make_room(m) && outgoing_make(m, &o) ? IMP_STATUS_OK : IMP_STATUS_INTERNAL;
    if (fault != NULL) {
        if (status == IMP_STATUS_OK) status = check_faces(m, fault);
        if (status == IMP_STATUS_OK) status = check_valences(m, &o, fault);
        if (status == IMP_STATUS_OK) status = check_edges(m, &o, fault);
    }
    if (status == IMP_STATUS_OK) {
        set_twins(m, &o);
        set_fans(m, &o);
        if (fault != NULL) status = check_fans(m, &o, fault);
        if (fault != NULL && status == IMP_STATUS_OK) status = check_pairs(m, fault);
    }
    outgoing_clear(&o);
    return status;
}

imp_status control_begin(control_mesh *m, triangles *from, double *velocity, const box_tables *loop,
                         triangles_fault *fault)
{
    *m = (control_mesh){.loop = loop,
                        .point_count = from->point_count,
                        .face_count = from->count,
                        .corner_count = from->corner_count,
                        .point = from->point,
                        .velocity = velocity,
                        .corner = from->corner};
    uint32_t *first = realloc(from->first, (m->face_count + 1) * sizeof *first);
    m->first = first != NULL ? first : from->first;
    *from = (triangles){0};
    if (first == NULL) return IMP_STATUS_INTERNAL;
    m->first[m->face_count] = (uint32_t)m->corner_count;
    return control_connect(m, fault);
}
