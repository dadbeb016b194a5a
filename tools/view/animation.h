/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_ANIMATION_H
#define TOOLS_VIEW_ANIMATION_H

#include "tools/view/film.h"

/* Films as files of other programs. IMP_SUCCESS, or memory that ran out; whether the file could be
 * written is the caller's to see. */

/* Wavefront OBJ: one frame, an object for each surface. */
imp_code animation_obj(const film *f, FILE *file, imp_error *error);

/* VTK: one frame as an unstructured grid of triangles, with body, surface, u and v. */
imp_code animation_vtu(const film *f, size_t frame, FILE *file, imp_error *error);

/* VTK: a list of the files of all moments, STEM_0000.vtu and so on. */
imp_code animation_pvd(const film *f, const char *stem, FILE *file, imp_error *error);

/* glTF 2.0, binary: rigid motions as tracks of nodes, deformations as morph targets. */
imp_code animation_glb(const film *f, FILE *file, imp_error *error);

#endif
