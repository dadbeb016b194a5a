/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <assert.h>
#include <string.h>

#include "core/common/array.h"
#include "core/scene/scene_internal.h"

/* The groups that bodies are in, and who ignores whom. */

/* --- Groups ----------------------------------------------------------------------------------- */

imp_code scene_add_group(imp_scene *scene, const char *name)
{
    char **grown =
        array_reserve(scene->groups, scene->group_count, &scene->group_capacity, sizeof *grown);
    if (grown == NULL) return IMP_ERROR_MEMORY;
    scene->groups = grown;
    grown[scene->group_count] = strdup(name);
    if (grown[scene->group_count] == NULL) return IMP_ERROR_MEMORY;
    scene->group_count += 1;
    return IMP_SUCCESS;
}

size_t scene_group_count(const imp_scene *scene) { return scene->group_count; }

const char *scene_group_name(const imp_scene *scene, size_t group)
{
    return group < scene->group_count ? scene->groups[group] : NULL;
}

imp_code scene_join(imp_scene *scene, size_t index, size_t group)
{
    assert(index < scene->count && group < scene->group_count);
    scene_body *b = &scene->bodies[index];
    size_t *grown = array_reserve(b->groups, b->group_count, &b->group_capacity, sizeof *grown);
    if (grown == NULL) return IMP_ERROR_MEMORY;
    b->groups = grown;
    b->groups[b->group_count++] = group;
    return IMP_SUCCESS;
}

/* --- Who ignores whom ------------------------------------------------------------------------- */

/* Returns the key of a body (even) or of a group (odd). */
static size_t key_of(scene_members m) { return 2 * m.index + m.is_group; }

imp_code scene_ignore_members(imp_scene *scene, scene_members x, scene_members y)
{
    return key_pairs_add(&scene->ignored, key_of(x), key_of(y)) ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

bool scene_key_is_of_body(size_t key) { return key % 2 == 0; }

size_t scene_body_key_count(const imp_scene *scene, size_t body)
{
    return 1 + scene->bodies[body].group_count;
}

size_t scene_body_key(const imp_scene *scene, size_t body, size_t k)
{
    if (k == 0) return key_of((scene_members){false, body});
    return key_of((scene_members){true, scene->bodies[body].groups[k - 1]});
}

const key_pairs *scene_ignored(const imp_scene *scene) { return &scene->ignored; }

enum { MANY_BODIES = 64 };

bool scene_counts_pairs(const imp_scene *scene)
{
    return scene->count >= MANY_BODIES && scene->ignored.count > 0;
}

bool scene_ignores(const imp_scene *scene, size_t a, size_t b)
{
    if (scene->ignored.count == 0) return false;
    for (size_t j = 0; j <= scene->bodies[a].group_count; ++j)
        for (size_t k = 0; k <= scene->bodies[b].group_count; ++k)
            if (key_pairs_have(&scene->ignored, scene_body_key(scene, a, j),
                               scene_body_key(scene, b, k)))
                return true;
    return false;
}

bool imp_scene_ignores(const imp_scene *scene, size_t a, size_t b)
{
    const size_t bodies = imp_scene_body_count(scene);
    if (a >= bodies || b >= bodies) return false;
    if (scene->bodies[a].count == 0 || scene->bodies[b].count == 0) return true;
    return scene_ignores(scene, a, b);
}

static imp_code copy_groups(const imp_scene *from, imp_scene *to)
{
    imp_code code = IMP_SUCCESS;
    for (size_t g = 0; g < from->group_count && code == IMP_SUCCESS; ++g)
        code = scene_add_group(to, from->groups[g]);
    for (size_t b = 0; b < from->count; ++b)
        for (size_t k = 0; k < from->bodies[b].group_count && code == IMP_SUCCESS; ++k)
            code = scene_join(to, b, from->bodies[b].groups[k]);
    return code;
}

imp_code scene_copy_relations(const imp_scene *from, imp_scene *to)
{
    assert(from->count == to->count);
    imp_code code = copy_groups(from, to);
    for (size_t k = 0; k < from->ignored.count && code == IMP_SUCCESS; ++k) {
        const size_t *key = from->ignored.at[k].key;
        if (!key_pairs_add(&to->ignored, key[0], key[1])) code = IMP_ERROR_MEMORY;
    }
    return code;
}
