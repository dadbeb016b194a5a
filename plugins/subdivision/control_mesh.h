/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_CONTROL_MESH_H
#define PLUGINS_SUBDIVISION_CONTROL_MESH_H

#include "plugins/mesh/triangles.h"
#include "plugins/patch/box_patch.h"

/* Control meshes of Catmull and Clark, and of Loop
 * ================================================
 * Faces of any number of corners, each of which begins a half-edge: from its point to that of the
 * next corner of the face. The same edge in the face beyond is its twin. All faces go round the
 * same way, at most two meet at an edge, and those at a point form one fan, which is closed or ends
 * at the border.
 *
 * One step of Catmull and Clark divides a face of n corners into n quads. With F the mean of a
 * face's points, F' that of the faces at a point and Q' that of its n neighbours along edges, the
 * points of the finer mesh are
 *
 *   of a face      F
 *   of an edge     the mean of its ends and both F; at the border the mean of its ends
 *   of a point P   (F' + Q' + (n - 2) P) / n; at the border (P_before + 6 P + P_after) / 8, along
 *                  it; at a corner of the border, where only one face is, P
 *
 * A mesh of Loop's has triangles, which one step divides into four. Its new points are
 *
 *   of an edge     (3 A + 3 B + C + D) / 8, C and D across it; at the border the mean of its ends
 *   of a point P   P + share (Q' - P), with a share of 5/8 - (3/8 + cos(2 pi / n) / 4)^2 for n
 *                  neighbours; at the border as above
 *
 * All of these are means with weights >= 0, so a mesh stays in the convex hull of its points. */

#define CONTROL_NONE UINT32_MAX

/* The most corners of a face, and the most faces at a point. */
enum { CONTROL_VALENCE_MAX = 256 };

/* What is known of a point. */
typedef struct control_point {
    uint32_t start; /* a half-edge that begins there, the first if the fan ends; or CONTROL_NONE */
    uint16_t faces;
    bool is_border;
} control_point;

typedef struct control_mesh {
    const box_tables
        *loop; /* what its patches are made with, not owned; NULL: of Catmull and Clark */
    size_t point_count, face_count, corner_count;
    double *point;      /* x, y, z of each */
    double *velocity;   /* the same; NULL: at rest */
    uint32_t *first;    /* half-edge of each face, and at last corner_count */
    uint32_t *corner;   /* of each half-edge: the point where it begins */
    uint32_t *face;     /* its face */
    uint32_t *twin;     /* CONTROL_NONE: it is at the border */
    control_point *fan; /* of each point */
    double slip[3];     /* at least |point - exact|, of x, y, z */
    double slip_motion[3];
} control_mesh; /* begins as {0}; control_clear frees */

void control_clear(control_mesh *m);

/* Frees what only control_begin and control_refine need. */
void control_settle(control_mesh *m);

static inline uint32_t control_next(const control_mesh *m, uint32_t h)
{
    const uint32_t f = m->face[h];
    return h + 1 < m->first[f + 1] ? h + 1 : m->first[f];
}

static inline uint32_t control_previous(const control_mesh *m, uint32_t h)
{
    const uint32_t f = m->face[h];
    return h > m->first[f] ? h - 1 : m->first[f + 1] - 1;
}

/* Where half-edge h ends. */
static inline uint32_t control_end(const control_mesh *m, uint32_t h)
{
    return m->corner[control_next(m, h)];
}

/* The half-edge from the same point in the next face counterclockwise, or clockwise. */
static inline uint32_t control_turn_left(const control_mesh *m, uint32_t h)
{
    return m->twin[control_previous(m, h)];
}

static inline uint32_t control_turn_right(const control_mesh *m, uint32_t h)
{
    return m->twin[h] != CONTROL_NONE ? control_next(m, m->twin[h]) : CONTROL_NONE;
}

static inline bool control_is_quad(const control_mesh *m, uint32_t f)
{
    return m->first[f + 1] - m->first[f] == 4;
}

/* Neighbours of a point with n faces around it count as much in Loop's scheme: within 2^-50. */
double control_loop_share(int n);

/* Takes points and faces over from `from`, and `velocity`; all are freed with the mesh, also when
 * this fails. `loop`: as above. IMP_STATUS_PARAMETER: a face or a point is not as above; *fault
 * says which and what may be done. */
imp_status control_begin(control_mesh *m, triangles *from, double *velocity, const box_tables *loop,
                         triangles_fault *fault);

/* The mesh after one step, of the faces that are `wanted` and of those that share a point with one.
 * (*wanted_fine)[f]: whether face f of the finer mesh comes of a wanted one. Points farther off are
 * there, but not where the whole mesh would have them. *wanted_fine: for free().
 * IMP_STATUS_INTERNAL: no memory. */
imp_status control_refine(const control_mesh *m, const bool *wanted, control_mesh *fine,
                          bool **wanted_fine);

#endif
