/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_COMPOSE_H
#define TESTS_SUPPORT_COMPOSE_H

#include "core/scene/scene.h"
#include "core/surface/instance.h"
#include "core/surface/region.h"

/* Surfaces, scenes and regions made by hand, without a reader. */

/* A surface of an instance that nothing else holds, and a map on top of it; both take over `self`,
 * also when memory runs out. */
static inline surface *surface_new(const imp_surface_type *type, void *self)
{
    shared_instance *p = instance_of_surface(type, self);
    surface *s = p != NULL ? surface_new_of(p) : NULL;
    instance_release(p);
    return s;
}

static inline imp_code surface_add_map(surface *s, const imp_map_type *type, void *self)
{
    shared_instance *p = instance_of_map(type, self);
    const imp_code code = p != NULL ? surface_add_instance(s, p) : IMP_ERROR_MEMORY;
    instance_release(p);
    return code;
}

static inline imp_code scene_ignore(imp_scene *scene, size_t a, size_t b)
{
    return scene_ignore_members(scene, (scene_members){false, a}, (scene_members){false, b});
}

static inline imp_region region_half(const imp_region *region, parameter j, int side)
{
    imp_region half;
    region_set_half(&half, region, j, side);
    return half;
}

#endif
