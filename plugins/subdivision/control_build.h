/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_CONTROL_BUILD_H
#define PLUGINS_SUBDIVISION_CONTROL_BUILD_H

#include "plugins/subdivision/control_mesh.h"

/* Fills face, twin and fan from first and corner. `fault`: where to say what is wrong with the
 * faces; NULL: nothing is, but that a part of a mesh has several fans at a point where it was
 * cut. */
imp_status control_connect(control_mesh *m, triangles_fault *fault);

/* The points of the finer mesh, from those of ours: `edge` has the number of the point of each
 * half-edge's edge. What they are off by is added to `slip`. */
void control_smooth(const control_mesh *m, const uint32_t *edge, const double *from, double *to,
                    double slip[3]);

#endif
