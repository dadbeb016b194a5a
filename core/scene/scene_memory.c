/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "core/scene/scene_internal.h"

static int compare_addresses(const void *x, const void *y)
{
    const uintptr_t a = *(const uintptr_t *)x, b = *(const uintptr_t *)y;
    return (a > b) - (a < b);
}

/* Addresses of instances, in any order. */
typedef struct address_list {
    uintptr_t *at;
    size_t count, capacity;
} address_list;

static bool add_address(address_list *list, const shared_instance *p)
{
    uintptr_t *grown = array_reserve(list->at, list->count, &list->capacity, sizeof *grown);
    if (grown == NULL) return false;
    list->at = grown;
    list->at[list->count++] = (uintptr_t)p;
    return true;
}

static bool add_addresses(address_list *list, const imp_scene *scene, size_t body)
{
    const scene_body *b = &scene->bodies[body];
    for (size_t k = 0; k < b->count; ++k)
        for (size_t stage = 0; stage <= surface_map_count(b->members[k].surface); ++stage)
            if (!add_address(list, surface_origin(b->members[k].surface, stage))) return false;
    if (scene->layout == NULL) return true;
    const instance_list *maps = &scene->layout[body].maps;
    for (size_t k = 0; k < maps->count; ++k)
        if (!add_address(list, maps->at[k])) return false;
    return true;
}

/* Each instance counts once, however many surfaces share it, and in each of the scenes that do: so
 * the sum does not depend on which other scenes there are. */
static imp_code sum_instances(const imp_scene *scene, uint64_t *bytes)
{
    address_list list = {.count = 0};
    bool kept = true;
    for (size_t b = 0; b < scene->count && kept; ++b) kept = add_addresses(&list, scene, b);
    if (list.count > 0) qsort(list.at, list.count, sizeof *list.at, compare_addresses);
    *bytes = 0;
    for (size_t k = 0; k < list.count; ++k)
        if (k == 0 || list.at[k] != list.at[k - 1])
            *bytes += instance_bytes((const shared_instance *)list.at[k]);
    free(list.at);
    return kept ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

static uint64_t sum_of_bytes(const imp_scene *scene)
{
    uint64_t bytes = sizeof *scene + scene->capacity * sizeof *scene->bodies +
                     scene->group_count * sizeof *scene->groups +
                     scene->ignored.capacity * sizeof *scene->ignored.at;
    for (size_t b = 0; b < scene->count; ++b) {
        const scene_body *body = &scene->bodies[b];
        bytes += strlen(body->name) + 1 + body->capacity * sizeof *body->members +
                 body->group_capacity * sizeof *body->groups + 2 * INSTANCE_BLOCK;
        for (size_t k = 0; k < body->count; ++k) bytes += surface_bytes(body->members[k].surface);
    }
    for (size_t b = 0; b < scene->count && scene->layout != NULL; ++b) {
        const instance_list *maps = &scene->layout[b].maps;
        bytes += sizeof *scene->layout + maps->capacity * sizeof *maps->at;
    }
    return bytes;
}

uint64_t scene_bytes(const imp_scene *scene)
{
    return scene->bytes > 0 ? scene->bytes : sum_of_bytes(scene);
}

imp_code scene_count_bytes(imp_scene *scene)
{
    uint64_t of_instances;
    if (sum_instances(scene, &of_instances) != IMP_SUCCESS) return IMP_ERROR_MEMORY;
    scene->bytes = sum_of_bytes(scene) + of_instances;
    return IMP_SUCCESS;
}
