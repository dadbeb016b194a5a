/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_REMARKS_H
#define CORE_SCENE_SCENE_REMARKS_H

#include "core/surface/surface.h"

/* What types noted when the instances of a scene were made (imp_scene_remark). An instance in many
 * surfaces is remarked on once, where it stands first. */

typedef struct scene_remarks {
    imp_remark *at;
    size_t count, capacity;
} scene_remarks; /* begins as {0} */

/* Adds the notes of surface `index` of a body, which keeps its instances alive. False: no
 * memory. */
bool scene_remarks_add(scene_remarks *r, const surface *s, size_t body, size_t index);
void scene_remarks_clear(scene_remarks *r);

/* For imp_scene_remark. */
bool scene_remarks_tell(const scene_remarks *r, size_t index, imp_remark *remark);

#endif
