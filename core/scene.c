/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "scene.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "scene_trees.h"
#include "status.h"

typedef struct member {
    surface *surface;
    tree **trees;
    size_t tree_count;
} member;

typedef struct body {
    char *name;
    member *members;
    size_t count;
} body;

struct imp_scene {
    body *bodies;
    size_t count;
    size_t (*ignored)[2];
    size_t ignored_count;
    scene_settings settings;
};

/* --- Building ------------------------------------------------------------------- */

imp_scene *scene_new(void)
{
    imp_scene *scene = calloc(1, sizeof *scene);
    if (scene != NULL) scene->settings = (scene_settings){0, 1, 1e-6, -1};
    return scene;
}

static void member_free(member *m)
{
    for (size_t k = 0; k < m->tree_count; ++k) tree_free(m->trees[k]);
    free(m->trees);
    surface_free(m->surface);
}

void imp_scene_free(imp_scene *scene)
{
    if (scene == NULL) return;
    for (size_t b = 0; b < scene->count; ++b) {
        for (size_t k = 0; k < scene->bodies[b].count; ++k)
            member_free(&scene->bodies[b].members[k]);
        free(scene->bodies[b].members);
        free(scene->bodies[b].name);
    }
    free(scene->bodies);
    free(scene->ignored);
    free(scene);
}

imp_code scene_add_body(imp_scene *scene, const char *name)
{
    body *bodies = realloc(scene->bodies, (scene->count + 1) * sizeof *bodies);
    if (bodies == NULL) return IMP_ERROR_MEMORY;
    scene->bodies = bodies;
    char *copy = malloc(strlen(name) + 1);
    if (copy == NULL) return IMP_ERROR_MEMORY;
    strcpy(copy, name);
    bodies[scene->count++] = (body){.name = copy};
    return IMP_SUCCESS;
}

imp_code scene_add_surface(imp_scene *scene, surface *s)
{
    assert(scene->count > 0);
    body *last = &scene->bodies[scene->count - 1];
    member *members = realloc(last->members, (last->count + 1) * sizeof *members);
    if (members == NULL) {
        surface_free(s);
        return IMP_ERROR_MEMORY;
    }
    surface_set_body(s, last->name, last->count);
    members[last->count++] = (member){.surface = s};
    last->members = members;
    return IMP_SUCCESS;
}

imp_code scene_ignore(imp_scene *scene, size_t a, size_t b)
{
    size_t(*pairs)[2] = realloc(scene->ignored, (scene->ignored_count + 1) * sizeof *pairs);
    if (pairs == NULL) return IMP_ERROR_MEMORY;
    pairs[scene->ignored_count][0] = a;
    pairs[scene->ignored_count][1] = b;
    scene->ignored = pairs;
    scene->ignored_count += 1;
    return IMP_SUCCESS;
}

/* --- Asking ------------------------------------------------------------------------ */

bool scene_ignores(const imp_scene *scene, size_t a, size_t b)
{
    for (size_t k = 0; k < scene->ignored_count; ++k) {
        const size_t *pair = scene->ignored[k];
        if ((pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a)) return true;
    }
    return false;
}

scene_settings *scene_settings_of(imp_scene *scene) { return &scene->settings; }

size_t imp_scene_body_count(const imp_scene *scene) { return scene->count; }

const char *imp_scene_body_name(const imp_scene *scene, size_t body)
{
    return body < scene->count ? scene->bodies[body].name : NULL;
}

size_t imp_scene_surface_count(const imp_scene *scene, size_t body)
{
    return body < scene->count ? scene->bodies[body].count : 0;
}

static const surface *scene_surface(const imp_scene *scene, size_t body, size_t index)
{
    if (index >= imp_scene_surface_count(scene, body)) return NULL;
    return scene->bodies[body].members[index].surface;
}

imp_code imp_scene_eval(const imp_scene *scene, size_t body, size_t index, size_t n,
                        const double *p, double *x, double *error, imp_error *why)
{
    const surface *s = scene_surface(scene, body, index);
    if (s == NULL)
        return error_set(why, IMP_ERROR_USAGE, "body %zu has no surface %zu", body, index);
    const imp_status status = surface_eval(s, n, p, x, error);
    if (status == IMP_OK) return IMP_SUCCESS;
    const imp_code code = surface_fault(s, why, ": %s", surface_status_text(status));
    if (status != IMP_DOMAIN) return code;
    if (why != NULL) why->code = IMP_ERROR_USAGE;
    return IMP_ERROR_USAGE;
}

void imp_scene_domain(const imp_scene *scene, size_t body, size_t index, double lo[3], double hi[3])
{
    const surface *s = scene_surface(scene, body, index);
    assert(s != NULL);
    surface_domain(s, lo, hi);
}

imp_options imp_options_default(const imp_scene *scene)
{
    const scene_settings *set = &scene->settings;
    return (imp_options){.t_start = set->t_start,
                         .t_end = set->t_end,
                         .gamma = set->gamma,
                         .clearance = set->clearance,
                         .max_bytes = (uint64_t)1 << 30,
                         .method = IMP_METHOD_MODELS,
                         .bounds = IMP_BOUNDS_BOX,
                         .rates = IMP_RATES_FULL};
}

/* --- Trees ----------------------------------------------------------------------------- */

imp_code scene_tree(imp_scene *scene, size_t body, size_t index, const tree_plan *plan,
                    lent_tree *lent, imp_error *error)
{
    member *m = &scene->bodies[body].members[index];
    for (size_t k = 0; k < m->tree_count; ++k)
        if (tree_is_of(m->trees[k], plan)) {
            *lent = (lent_tree){m->trees[k], false};
            return IMP_SUCCESS;
        }
    tree **trees = realloc(m->trees, (m->tree_count + 1) * sizeof *trees);
    if (trees == NULL) return error_set_memory(error);
    m->trees = trees;
    const imp_code code = tree_new(m->surface, plan, &trees[m->tree_count], error);
    if (code == IMP_SUCCESS) *lent = (lent_tree){trees[m->tree_count++], true};
    return code;
}
