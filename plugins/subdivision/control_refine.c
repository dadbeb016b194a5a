/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/control_build.h"

/* --- The part of a mesh that a step needs ----------------------------------------------------- */

/* Faces that share a point with a wanted one, and their points; CONTROL_NONE: left out. */
typedef struct selection {
    uint32_t *point, *face; /* numbers in the part */
    size_t points, faces, corners;
} selection;

static void select_points(const control_mesh *m, const bool *of_face, uint32_t *point)
{
    for (size_t p = 0; p < m->point_count; ++p) point[p] = CONTROL_NONE;
    for (size_t h = 0; h < m->corner_count; ++h)
        if (of_face[m->face[h]]) point[m->corner[h]] = 0;
}

static bool touches(const control_mesh *m, uint32_t f, const uint32_t *point)
{
    for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h)
        if (point[m->corner[h]] != CONTROL_NONE) return true;
    return false;
}

static bool select_part(const control_mesh *m, const bool *wanted, selection *s)
{
    bool *chosen = malloc(m->face_count * sizeof *chosen);
    s->point = malloc(m->point_count * sizeof *s->point);
    s->face = malloc(m->face_count * sizeof *s->face);
    if (chosen != NULL && s->point != NULL && s->face != NULL) {
        select_points(m, wanted, s->point);
        for (uint32_t f = 0; f < m->face_count; ++f) {
            chosen[f] = touches(m, f, s->point);
            s->face[f] = chosen[f] ? (uint32_t)s->faces++ : CONTROL_NONE;
            if (chosen[f]) s->corners += m->first[f + 1] - m->first[f];
        }
        select_points(m, chosen, s->point);
        for (size_t p = 0; p < m->point_count; ++p)
            if (s->point[p] != CONTROL_NONE) s->point[p] = (uint32_t)s->points++;
    }
    const bool made = chosen != NULL && s->point != NULL && s->face != NULL;
    free(chosen);
    return made;
}

static double *part_of(const double *list, const control_mesh *m, const selection *s)
{
    double *part = malloc(3 * s->points * sizeof *part);
    for (size_t p = 0; part != NULL && p < m->point_count; ++p)
        if (s->point[p] != CONTROL_NONE)
            memcpy(part + 3 * (size_t)s->point[p], list + 3 * p, 3 * sizeof *part);
    return part;
}

static imp_status cut(const control_mesh *m, const selection *s, control_mesh *part)
{
    *part = (control_mesh){.loop = m->loop,
                           .point_count = s->points,
                           .face_count = s->faces,
                           .corner_count = s->corners};
    part->point = part_of(m->point, m, s);
    part->velocity = m->velocity != NULL ? part_of(m->velocity, m, s) : NULL;
    part->first = malloc((s->faces + 1) * sizeof *part->first);
    part->corner = malloc(s->corners * sizeof *part->corner);
    if (part->point == NULL || (part->velocity == NULL) != (m->velocity == NULL) ||
        part->first == NULL || part->corner == NULL)
        return IMP_STATUS_INTERNAL;
    uint32_t used = 0;
    for (uint32_t f = 0; f < m->face_count; ++f) {
        if (s->face[f] == CONTROL_NONE) continue;
        part->first[s->face[f]] = used;
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h)
            part->corner[used++] = s->point[m->corner[h]];
    }
    part->first[s->faces] = used;
    memcpy(part->slip, m->slip, sizeof part->slip);
    memcpy(part->slip_motion, m->slip_motion, sizeof part->slip_motion);
    return control_connect(part, NULL);
}

/* --- Topology --------------------------------------------------------------------------------- */

/* The points of the finer mesh are those of the points, of the faces (not of triangles of Loop's),
 * and of the edges, which have the numbers of their first half-edge: edge[h]. */
static uint32_t *number_edges(const control_mesh *m, size_t *points)
{
    uint32_t *edge = malloc(m->corner_count * sizeof *edge);
    *points = m->point_count + (m->loop == NULL ? m->face_count : 0);
    for (uint32_t h = 0; edge != NULL && h < m->corner_count; ++h) {
        const uint32_t twin = m->twin[h];
        edge[h] = twin < h ? edge[twin] : (uint32_t)(*points)++;
    }
    return edge;
}

/* Half-edge h gives the quad of its point, its edge, its face and the edge before it. */
static void set_quads(const control_mesh *m, const uint32_t *edge, control_mesh *fine)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        uint32_t *corner = fine->corner + 4 * (size_t)h;
        fine->first[h] = 4 * h;
        corner[0] = m->corner[h];
        corner[1] = edge[h];
        corner[2] = (uint32_t)m->point_count + m->face[h];
        corner[3] = edge[control_previous(m, h)];
    }
    fine->first[m->corner_count] = 4 * (uint32_t)m->corner_count;
}

/* Half-edge h gives the triangle of its point, its edge and the edge before it; those of the edges
 * are the face's fourth. */
static void set_triangles(const control_mesh *m, const uint32_t *edge, control_mesh *fine)
{
    for (uint32_t f = 0; f < m->face_count; ++f)
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t h = m->first[f] + k;
            uint32_t *corner = fine->corner + 12 * (size_t)f;
            corner[3 * k] = m->corner[h];
            corner[3 * k + 1] = edge[h];
            corner[3 * k + 2] = edge[control_previous(m, h)];
            corner[9 + k] = edge[h];
        }
    for (uint32_t f = 0; f <= fine->face_count; ++f) fine->first[f] = 3 * f;
}

/* Face f of the finer mesh is the first that comes of ours. */
static uint32_t first_child(const control_mesh *m, uint32_t f)
{
    return m->loop != NULL ? 4 * f : m->first[f];
}

static imp_status refine_part(const control_mesh *m, control_mesh *fine)
{
    size_t points;
    uint32_t *edge = number_edges(m, &points);
    *fine = (control_mesh){.loop = m->loop,
                           .point_count = points,
                           .face_count = first_child(m, (uint32_t)m->face_count),
                           .corner_count = 4 * m->corner_count};
    fine->point = malloc(3 * points * sizeof *fine->point);
    fine->first = malloc((fine->face_count + 1) * sizeof *fine->first);
    fine->corner = malloc(fine->corner_count * sizeof *fine->corner);
    if (m->velocity != NULL) fine->velocity = malloc(3 * points * sizeof *fine->velocity);
    const bool made = edge != NULL && fine->point != NULL && fine->first != NULL &&
                      fine->corner != NULL && (fine->velocity == NULL) == (m->velocity == NULL);
    if (made) {
        if (m->loop != NULL)
            set_triangles(m, edge, fine);
        else
            set_quads(m, edge, fine);
        memcpy(fine->slip, m->slip, sizeof fine->slip);
        control_smooth(m, edge, m->point, fine->point, fine->slip);
    }
    if (made && m->velocity != NULL) {
        memcpy(fine->slip_motion, m->slip_motion, sizeof fine->slip_motion);
        control_smooth(m, edge, m->velocity, fine->velocity, fine->slip_motion);
    }
    free(edge);
    return made ? control_connect(fine, NULL) : IMP_STATUS_INTERNAL;
}

/* Which of the finer faces come of wanted ones. NULL: no memory. */
static bool *children_of(const control_mesh *m, const bool *wanted, const selection *s,
                         const control_mesh *part)
{
    bool *children = malloc(first_child(part, (uint32_t)part->face_count) * sizeof *children);
    for (uint32_t f = 0; children != NULL && f < m->face_count; ++f) {
        if (s->face[f] == CONTROL_NONE) continue;
        const uint32_t end = first_child(part, s->face[f] + 1);
        for (uint32_t k = first_child(part, s->face[f]); k < end; ++k) children[k] = wanted[f];
    }
    return children;
}

imp_status control_refine(const control_mesh *m, const bool *wanted, control_mesh *fine,
                          bool **wanted_fine)
{
    selection s = {0};
    control_mesh part = {0};
    imp_status status = select_part(m, wanted, &s) ? cut(m, &s, &part) : IMP_STATUS_INTERNAL;
    if (status == IMP_STATUS_OK) status = refine_part(&part, fine);
    if (status == IMP_STATUS_OK) {
        *wanted_fine = children_of(m, wanted, &s, &part);
        if (*wanted_fine == NULL) status = IMP_STATUS_INTERNAL;
    }
    control_clear(&part);
    free(s.point);
    free(s.face);
    return status;
}
