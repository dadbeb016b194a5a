/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_change.h"

#include "core/scene/scene_internal.h"

/* Instances that a changed scene is rid of, for the next change of the same type: it refills one
 * (capability `renew`) in the place of destroying one and creating another. The scene's own is
 * exchanged only when that has succeeded, so a failure leaves the scene as it was. Their bytes are
 * those of the scene meanwhile. */

/* Larger instances are destroyed: their create costs more than the memory that a spare one holds,
 * but a scene would hold it twice. Bytes. */
enum { SPARE_BYTES_MOST = 1 << 17 };

static bool is_of(const shared_instance *p, const imp_surface_type *type, const imp_map_type *map,
                  size_t given)
{
    return p->surface == type && p->map == map && p->given == given;
}

/* Takes the one at place k out. */
static shared_instance *take_out(imp_scene *scene, size_t k)
{
    shared_instance *taken = scene->spare[k];
    scene->bytes -= instance_bytes(taken);
    for (; k + 1 < scene->spare_count; ++k) scene->spare[k] = scene->spare[k + 1];
    --scene->spare_count;
    return taken;
}

shared_instance *scene_take_spare(imp_scene *scene, const imp_surface_type *type,
                                  const imp_map_type *map, size_t given)
{
    for (size_t k = scene->spare_count; k-- > 0;)
        if (is_of(scene->spare[k], type, map, given)) return take_out(scene, k);
    return NULL;
}

static bool is_renewable(const shared_instance *p)
{
    return p->surface != NULL ? IMP_OFFERS(p->surface, renew) : IMP_OFFERS(p->map, renew);
}

void scene_give_spare(imp_scene *scene, shared_instance *p)
{
    if (p->holders > 1 || p->inner != NULL || !is_renewable(p) ||
        instance_bytes(p) > SPARE_BYTES_MOST) {
        instance_release(p);
        return;
    }
    instance_clear_shelf(p);
    if (scene->spare_count == SCENE_SPARES) instance_release(take_out(scene, 0));
    scene->spare[scene->spare_count++] = p;
    scene->bytes += instance_bytes(p);
}

void scene_free_spares(imp_scene *scene)
{
    while (scene->spare_count > 0) instance_release(take_out(scene, 0));
}
