/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef PLUGINS_SUBDIVISION_CONTROL_BUILD_H
#define PLUGINS_SUBDIVISION_CONTROL_BUILD_H

#include "plugins/subdivision/control_mesh.h"

/* Fills face, twin and fan from first and corner. `fault`: where to say what is wrong with the faces;
 * NULL: nothing is, but that a part of a mesh has several fans at a point where it was cut. */
imp_status control_connect(control_mesh *m, triangles_fault *fault);

#endif
