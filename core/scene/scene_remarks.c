/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_remarks.h"

#include <stdlib.h>

#include "core/base/sized.h"
#include "core/common/array.h"

/* The text of a remark is the instance's own. A scene has few instances with notes: files of
 * meshes, once each. */
static bool is_known(const scene_remarks *r, const shared_instance *p)
{
    for (size_t k = 0; k < r->count; ++k)
        if (r->at[k].text == p->note) return true;
    return false;
}

bool scene_remarks_add(scene_remarks *r, const surface *s, size_t body, size_t index)
{
    for (size_t k = 0; k <= surface_map_count(s); ++k) {
        const shared_instance *p = surface_origin(s, k);
        if (p->note_count == 0 || is_known(r, p)) continue;
        imp_remark *grown = array_reserve(r->at, r->count, &r->capacity, sizeof *grown);
        if (grown == NULL) return false;
        r->at = grown;
        r->at[r->count++] = (imp_remark){.struct_size = (uint32_t)sizeof(imp_remark),
                                         .body = body,
                                         .surface = index,
                                         .map = k > 0 ? k - 1 : SIZE_MAX,
                                         .type = k > 0 ? p->map->name : p->surface->name,
                                         .count = p->note_count,
                                         .text = p->note};
    }
    return true;
}

void scene_remarks_clear(scene_remarks *r)
{
    free(r->at);
    *r = (scene_remarks){.count = 0};
}

bool scene_remarks_tell(const scene_remarks *r, size_t index, imp_remark *remark)
{
    if (index >= r->count || sized_check("imp_remark", remark, sizeof *remark, NULL) != IMP_SUCCESS)
        return false;
    sized_write(remark, &r->at[index]);
    return true;
}
