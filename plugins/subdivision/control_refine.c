/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/subdivision/control_build.h"

#include <impinge/interval.h>

/* --- The part of a mesh that a step needs --------------------------------------------------------- */

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
    *part = (control_mesh){.point_count = s->points, .face_count = s->faces,
                           .corner_count = s->corners};
    part->point = part_of(m->point, m, s);
    part->velocity = m->velocity != NULL ? part_of(m->velocity, m, s) : NULL;
    part->first = malloc((s->faces + 1) * sizeof *part->first);
    part->corner = malloc(s->corners * sizeof *part->corner);
    if (part->point == NULL || (part->velocity == NULL) != (m->velocity == NULL) ||
        part->first == NULL || part->corner == NULL)
        return IMP_INTERNAL;
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

/* --- Topology -------------------------------------------------------------------------------------- */

/* The points of the finer mesh are those of the points, of the faces, and of the edges, which have the
 * numbers of their first half-edge: edge[h]. */
static uint32_t *number_edges(const control_mesh *m, size_t *points)
{
    uint32_t *edge = malloc(m->corner_count * sizeof *edge);
    *points = m->point_count + m->face_count;
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

/* --- Points ------------------------------------------------------------------------------------------ */

static void add(double sum[3], const double *list, size_t k, double factor)
{
    for (size_t i = 0; i < 3; ++i) sum[i] += factor * list[3 * k + i];
}

static void set_face_points(const control_mesh *m, const double *from, double *to)
{
    for (uint32_t f = 0; f < m->face_count; ++f) {
        double *x = to + 3 * (m->point_count + f), sum[3] = {0, 0, 0};
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; ++h) add(sum, from, m->corner[h], 1);
        for (int i = 0; i < 3; ++i) x[i] = sum[i] / (m->first[f + 1] - m->first[f]);
    }
}

static void set_edge_points(const control_mesh *m, const uint32_t *edge, const double *from,
                            double *to)
{
    for (uint32_t h = 0; h < m->corner_count; ++h) {
        const uint32_t twin = m->twin[h];
        if (twin < h) continue;
        const double share = twin == CONTROL_NONE ? 0.5 : 0.25;
        double sum[3] = {0, 0, 0};
        add(sum, from, m->corner[h], share);
        add(sum, from, control_end(m, h), share);
        if (twin != CONTROL_NONE) {
            add(sum, to, m->point_count + m->face[h], share);
            add(sum, to, m->point_count + m->face[twin], share);
        }
        memcpy(to + 3 * (size_t)edge[h], sum, sizeof sum);
    }
}

/* The neighbours of a border point along the border: the end of the first half-edge of its fan, and the
 * beginning of the last one's predecessor. */
static void smooth_border(const control_mesh *m, const control_point *p, const double *from,
                          double x[3])
{
    uint32_t last = p->start;
    for (uint16_t k = 1; k < p->faces; ++k) last = control_turn_left(m, last);
    if (p->faces == 1) {
        add(x, from, m->corner[last], 1);
        return;
    }
    add(x, from, m->corner[last], 0.75);
    add(x, from, control_end(m, p->start), 0.125);
    add(x, from, m->corner[control_previous(m, last)], 0.125);
}

static void smooth_point(const control_mesh *m, const control_point *p, const double *from,
                         const double *to, double x[3])
{
    const double n = p->faces;
    double around[3] = {0, 0, 0};
    uint32_t h = p->start;
    for (uint16_t k = 0; k < p->faces; ++k, h = control_turn_left(m, h)) {
        add(around, to, m->point_count + m->face[h], 1);
        add(around, from, control_end(m, h), 1);
    }
    for (size_t i = 0; i < 3; ++i)
        x[i] = (around[i] / n + (n - 2) * from[3 * (size_t)m->corner[h] + i]) / n;
}

static void set_points(const control_mesh *m, const uint32_t *edge, const double *from, double *to)
{
    set_face_points(m, from, to);
    set_edge_points(m, edge, from, to);
    for (uint32_t p = 0; p < m->point_count; ++p) {
        double x[3] = {0, 0, 0};
        if (m->fan[p].start == CONTROL_NONE)
            add(x, from, p, 1);
        else if (m->fan[p].is_border)
            smooth_border(m, &m->fan[p], from, x);
        else
            smooth_point(m, &m->fan[p], from, to, x);
        memcpy(to + 3 * (size_t)p, x, sizeof x);
    }
}

/* Lemma. All points are means of coarser ones, of which none is greater than `most`. Roundings, in units
 * of 2^-53 most: a face's n - 1 sums and a quotient n; an edge's 3 sums more; of a point with n faces,
 * the 2 n sums of means (each at most n most, later divided by n) 2 n beside those of the faces, and 5
 * more: together below n_face + 2 n + 8. What the coarser points were off counts once, as weights add
 * up to 1. */
static void add_slip(const control_mesh *m, const double *list, double slip[3])
{
    uint32_t corners = 0, faces = 0;
    for (size_t f = 0; f < m->face_count; ++f)
        if (m->first[f + 1] - m->first[f] > corners) corners = m->first[f + 1] - m->first[f];
    for (size_t p = 0; p < m->point_count; ++p)
        if (m->fan[p].faces > faces) faces = m->fan[p].faces;
    const double units = corners + 2.0 * faces + 8;
    for (size_t i = 0; i < 3; ++i) {
        double most = 0;
        for (size_t p = 0; p < m->point_count; ++p) most = imp_larger(most, fabs(list[3 * p + i]));
        slip[i] = (slip[i] + units * 0x1p-53 * most) * (1 + 0x1p-40) + IMP_TINY;
    }
}

static imp_status refine_part(const control_mesh *m, control_mesh *fine)
{
    size_t points;
    uint32_t *edge = number_edges(m, &points);
    *fine = (control_mesh){.point_count = points, .face_count = m->corner_count,
                           .corner_count = 4 * m->corner_count};
    fine->point = malloc(3 * points * sizeof *fine->point);
    fine->first = malloc((fine->face_count + 1) * sizeof *fine->first);
    fine->corner = malloc(fine->corner_count * sizeof *fine->corner);
    if (m->velocity != NULL) fine->velocity = malloc(3 * points * sizeof *fine->velocity);
    const bool made = edge != NULL && fine->point != NULL && fine->first != NULL &&
                      fine->corner != NULL && (fine->velocity == NULL) == (m->velocity == NULL);
    if (made) {
        set_quads(m, edge, fine);
        set_points(m, edge, m->point, fine->point);
        memcpy(fine->slip, m->slip, sizeof fine->slip);
        add_slip(m, m->point, fine->slip);
    }
    if (made && m->velocity != NULL) {
        set_points(m, edge, m->velocity, fine->velocity);
        memcpy(fine->slip_motion, m->slip_motion, sizeof fine->slip_motion);
        add_slip(m, m->velocity, fine->slip_motion);
    }
    free(edge);
    return made ? control_connect(fine, NULL) : IMP_INTERNAL;
}

/* Which of the quads come of wanted faces. NULL: no memory. */
static bool *quads_of(const control_mesh *m, const bool *wanted, const selection *s,
                      const control_mesh *part)
{
    bool *quads = malloc(part->corner_count * sizeof *quads);
    for (uint32_t f = 0; quads != NULL && f < m->face_count; ++f) {
        if (s->face[f] == CONTROL_NONE) continue;
        const uint32_t from = part->first[s->face[f]], to = part->first[s->face[f] + 1];
        for (uint32_t h = from; h < to; ++h) quads[h] = wanted[f];
    }
    return quads;
}

imp_status control_refine(const control_mesh *m, const bool *wanted, control_mesh *fine,
                          bool **wanted_fine)
{
    selection s = {0};
    control_mesh part = {0};
    imp_status status = select_part(m, wanted, &s) ? cut(m, &s, &part) : IMP_INTERNAL;
    if (status == IMP_OK) status = refine_part(&part, fine);
    if (status == IMP_OK) {
        *wanted_fine = quads_of(m, wanted, &s, &part);
        if (*wanted_fine == NULL) status = IMP_INTERNAL;
    }
    control_clear(&part);
    free(s.point);
    free(s.face);
    return status;
}
