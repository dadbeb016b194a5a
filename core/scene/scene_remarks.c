/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_remarks.h"

#include <stdlib.h>

#include "core/base/sized.h"

/* A scene has few instances with notes: files of meshes, once each. */
static bool is_known(const scene_remarks *r, const shared_instance *p)
{
    for (size_t k = 0; k < r->count; ++k)
        if (r->of[k] == p) return true;
    return false;
}

static bool reserve(scene_remarks *r)
{
    if (r->count < r->capacity) return true;
    const size_t wanted = 2 * r->capacity + 4;
    imp_remark *at = realloc(r->at, wanted * sizeof *at);
    if (at == NULL) return false;
    r->at = at;
    const shared_instance **of = realloc(r->of, wanted * sizeof(const shared_instance *));
    if (of == NULL) return false;
    r->of = of;
    r->capacity = wanted;
    return true;
}

bool scene_remarks_add(scene_remarks *r, const surface *s, size_t body, size_t index)
{
    for (size_t k = 0; k <= surface_map_count(s); ++k) {
        const shared_instance *p = surface_origin(s, k);
        if (p->note_count == 0 || is_known(r, p)) continue;
        if (!reserve(r)) return false;
        r->of[r->count] = p;
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
    free(r->of);
    *r = (scene_remarks){.count = 0};
}

bool scene_remarks_tell(const scene_remarks *r, size_t index, imp_remark *remark)
{
    if (index >= r->count || sized_check("imp_remark", remark, sizeof *remark, NULL) != IMP_SUCCESS)
        return false;
    sized_write(remark, &r->at[index]);
    return true;
}
