/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/scene_bodies.h"

#include <stdio.h>
#include <string.h>

#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/registry.h"

/* --- Creation and destruction ----------------------------------------------------------------- */

imp_code scene_bodies_start(scene_bodies *b, const scene_source *source, imp_error *error)
{
    *b = (scene_bodies){
        .instances = {.source = *source, .error = error}, .names = json_object(), .error = error};
    if (!assembly_begin(&b->assembly) || b->names == NULL) return error_set_memory(error);
    scene_set_registry(b->assembly.scene, source->registry);
    scene_set_store(b->assembly.scene, registry_store(source->registry));
    b->instances.source.files = scene_files_of(b->assembly.scene);
    b->instances.parameters = scene_parameters_of(b->assembly.scene);
    return IMP_SUCCESS;
}

void scene_bodies_clear(scene_bodies *b)
{
    json_decref(b->names);
    b->names = NULL;
    scene_instances_clear(&b->instances);
    assembly_clear(&b->assembly);
}

imp_scene *scene_bodies_finish(scene_bodies *b, const place *at)
{
    imp_scene *scene = NULL;
    assembly_skip_bare_parents(&b->assembly);
    if (assembly_is_too_large(&b->assembly)) {
        place_error(at, b->error, IMP_ERROR_SCENE,
                    "found more than %u maps on all surfaces together, those of parents included",
                    ASSEMBLY_WORK_MAX);
    } else {
        instance_table_clear(&b->instances.made); /* holders share what a scene counts of a part */
        scene = assembly_finish(&b->assembly);
        if (scene == NULL) error_set_memory(b->error);
    }
    scene_bodies_clear(b);
    return scene;
}

/* --- Names ------------------------------------------------------------------------------------ */

static imp_code keep(const scene_bodies *b, bool kept)
{
    return kept ? IMP_SUCCESS : error_set_memory(b->error);
}

static imp_code add_name(scene_bodies *b, const char *name, json_int_t number)
{
    return keep(b, json_object_set_new(b->names, name, json_integer(number)) == 0);
}

static imp_code check_line(const scene_bodies *b, const char *name, const place *at)
{
    if (*name != '\0' && text_is_line(name)) return IMP_SUCCESS;
    return place_error(at, b->error, IMP_ERROR_SCENE, "got \"%.80s\", must be one line of text",
                       name);
}

imp_code scene_bodies_begin(scene_bodies *b, const char *name, const place *at)
{
    const size_t index = b->assembly.count;
    char text[40];
    snprintf(text, sizeof text, "body%zu", index);
    if (name == NULL) name = text;
    imp_code code = check_line(b, name, at);
    if (code != IMP_SUCCESS) return code;
    const json_t *earlier = json_object_get(b->names, name);
    if (earlier != NULL && json_integer_value(earlier) < 0)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "got the name '%.80s', which a group has; names must be unique", name);
    if (earlier != NULL)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "got the name '%.80s', which body %lld has; names must be unique", name,
                           (long long)json_integer_value(earlier));
    code = add_name(b, name, (json_int_t)index);
    return code == IMP_SUCCESS ? keep(b, assembly_add_body(&b->assembly, name)) : code;
}

/* What was meant? Groups only if they are allowed too. */
static imp_code refuse_name(const scene_bodies *b, const char *name, bool groups, const place *at)
{
    const imp_scene *scene = b->assembly.scene;
    spelling_search search = {.wanted = name};
    for (size_t i = 0; i < b->assembly.count; ++i)
        spelling_offer(&search, imp_scene_body_name(scene, i));
    for (size_t g = 0; groups && g < scene_group_count(scene); ++g)
        spelling_offer(&search, scene_group_name(scene, g));
    const char *or_group = groups ? " or group" : "";
    if (search.best != NULL)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "got \"%.80s\", which is not a body%s; did you mean '%s'?", name,
                           or_group, search.best);
    return place_error(at, b->error, IMP_ERROR_SCENE, "got \"%.80s\", must be the name of a body%s",
                       name, or_group);
}

static imp_code find(const scene_bodies *b, const char *name, bool groups, const place *at,
                     scene_members *found)
{
    const json_t *json = json_object_get(b->names, name);
    const json_int_t number = json_integer_value(json);
    if (json == NULL || (number < 0 && !groups)) return refuse_name(b, name, groups, at);
    *found = number < 0 ? (scene_members){true, (size_t)(-1 - number)}
                        : (scene_members){false, (size_t)number};
    return IMP_SUCCESS;
}

/* --- Parameters ------------------------------------------------------------------------------- */

imp_code scene_bodies_parameter(scene_bodies *b, const char *name, double lo, double hi,
                                const place *at)
{
    const imp_code code = check_line(b, name, at);
    if (code != IMP_SUCCESS) return code;
    if (strcmp(name, "time") == 0 || strchr(name, '=') != NULL)
        return place_error(
            at, b->error, IMP_ERROR_SCENE,
            "got the name \"%.80s\", must be a name other than \"time\", which every "
            "scene has, and without '='",
            name);
    return scene_instances_parameter(&b->instances, name, lo, hi, at);
}

/* --- Groups ----------------------------------------------------------------------------------- */

imp_code scene_bodies_join(scene_bodies *b, size_t body, const char *name, const place *at)
{
    imp_scene *scene = b->assembly.scene;
    imp_code code = check_line(b, name, at);
    const json_t *known = json_object_get(b->names, name);
    if (code == IMP_SUCCESS && known != NULL && json_integer_value(known) >= 0)
        return place_error(at, b->error, IMP_ERROR_SCENE,
                           "found the group '%.80s', which is the name of body %lld; must be "
                           "names that no body has",
                           name, (long long)json_integer_value(known));
    size_t group = scene_group_count(scene);
    if (known != NULL) {
        group = (size_t)(-1 - json_integer_value(known));
    } else if (code == IMP_SUCCESS) {
        code = add_name(b, name, -1 - (json_int_t)group);
        if (code == IMP_SUCCESS) code = keep(b, scene_add_group(scene, name) == IMP_SUCCESS);
    }
    return code == IMP_SUCCESS ? keep(b, scene_join(scene, body, group) == IMP_SUCCESS) : code;
}

/* --- Bodies of another scene ------------------------------------------------------------------ */

imp_code scene_bodies_copy(scene_bodies *b, const imp_scene *scene, const place *at)
{
    imp_code code = IMP_SUCCESS;
    for (size_t k = 0; k < scene_body_count(scene) && code == IMP_SUCCESS; ++k) {
        code = scene_bodies_begin(b, imp_scene_body_name(scene, k), at);
        if (code == IMP_SUCCESS) code = keep(b, assembly_copy_body(&b->assembly, k, scene));
    }
    for (size_t g = 0; g < scene_group_count(scene) && code == IMP_SUCCESS; ++g)
        code = add_name(b, scene_group_name(scene, g), -1 - (json_int_t)g);
    if (code != IMP_SUCCESS) return code;
    named_files *files = scene_files_of(b->assembly.scene);
    return keep(b, scene_copy_relations(scene, b->assembly.scene) == IMP_SUCCESS &&
                       named_files_copy(scene_files_named(scene), files));
}

/* --- Parents ---------------------------------------------------------------------------------- */

imp_code scene_bodies_set_parent(scene_bodies *b, size_t body, const char *parent, const place *at)
{
    scene_members found = {.is_group = false};
    const imp_code code = find(b, parent, false, at, &found);
    if (code == IMP_SUCCESS) b->assembly.bodies[body].parent = found.index;
    return code;
}

imp_code scene_bodies_refuse_cycle(const scene_bodies *b, size_t body, const place *at)
{
    char chain[240] = "";
    size_t up = body;
    do {
        text_append(chain, sizeof chain, "'%.60s', whose parent is ",
                    imp_scene_body_name(b->assembly.scene, up));
        up = b->assembly.bodies[up].parent;
    } while (up != body && strlen(chain) < 160);
    text_append(chain, sizeof chain, up == body ? "'%.60s' again" : "... '%.60s' again",
                imp_scene_body_name(b->assembly.scene, body));
    return place_error(at, b->error, IMP_ERROR_SCENE,
                       "got a circle of parents: %s; must be a parent that is not the body "
                       "itself nor moves with it",
                       chain);
}

/* --- Who ignores whom ------------------------------------------------------------------------- */

imp_code scene_bodies_ignore(scene_bodies *b, const char *x, const place *at_x, const char *y,
                             const place *at_y)
{
    scene_members m[2];
    imp_code code = find(b, x, true, at_x, &m[0]);
    if (code == IMP_SUCCESS) code = find(b, y, true, at_y, &m[1]);
    if (code != IMP_SUCCESS) return code;
    if (!m[0].is_group && !m[1].is_group && m[0].index == m[1].index)
        return place_error(at_y->up != NULL ? at_y->up : at_y, b->error, IMP_ERROR_SCENE,
                           "got the same body twice, must be two bodies; surfaces of one body "
                           "are never tested with each other");
    return keep(b, scene_ignore_members(b->assembly.scene, m[0], m[1]) == IMP_SUCCESS);
}
