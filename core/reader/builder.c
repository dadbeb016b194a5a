/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/fp_mode.h"
#include "core/reader/builder_internal.h"
#include "core/scene/tolerances.h"

/* A builder from its creation to the finished scene; builder_stages.c adds surfaces and maps. */

/* --- Creation and destruction ----------------------------------------------------------------- */

imp_builder *imp_builder_new(imp_registry *registry)
{
    imp_builder *b = registry != NULL ? calloc(1, sizeof *b) : NULL;
    if (b == NULL) return NULL;
    b->registry = registry;
    const scene_source source = {.registry = registry};
    if (scene_bodies_start(&b->bodies, &source, NULL) == IMP_SUCCESS) return b;
    imp_builder_free(b);
    return NULL;
}

static FP_APART void clear(imp_builder *b) { scene_bodies_clear(&b->bodies); }

void imp_builder_free(imp_builder *b)
{
    if (b == NULL) return;
    const fp_environment environment = fp_environment_enter();
    if (!b->finished) clear(b);
    fp_environment_leave(&environment);
    free(b);
}

/* --- What calls begin with ----------------------------------------------------------------- */

imp_code builder_enter(imp_builder *b, imp_error *error)
{
    if (b == NULL) return error_set(error, IMP_ERROR_USAGE, "the builder is NULL");
    if (b->finished)
        return error_set(error, IMP_ERROR_USAGE, "this builder has made its scene already");
    b->bodies.error = b->bodies.instances.error = error;
    return IMP_SUCCESS;
}

imp_code builder_check_body(const imp_builder *b, size_t body, imp_error *error)
{
    if (body < b->bodies.assembly.count) return IMP_SUCCESS;
    return error_set(error, IMP_ERROR_USAGE, "body %zu: there are only %zu bodies so far", body,
                     b->bodies.assembly.count);
}

body_words builder_body_words(const imp_builder *b, size_t body)
{
    body_words words;
    snprintf(words.at, sizeof words.at, "body '%.80s'",
             imp_scene_body_name(b->bodies.assembly.scene, body));
    return words;
}

/* --- Settings --------------------------------------------------------------------------------- */

imp_code imp_builder_time(imp_builder *b, double start, double end, imp_error *error)
{
    const imp_code code = builder_enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (!(isfinite(start) && isfinite(end) && start <= end))
        return error_set(error, IMP_ERROR_USAGE,
                         "time: got [%.17g, %.17g], must be finite with start <= end", start, end);
    scene_settings *s = scene_settings_of(b->bodies.assembly.scene);
    s->t_start = start;
    s->t_end = end;
    return IMP_SUCCESS;
}

imp_code imp_builder_gamma(imp_builder *b, double gamma, double gamma_clear, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = tolerances_check(gamma, gamma_clear, NULL, error);
    if (code != IMP_SUCCESS) return code;
    scene_settings *s = scene_settings_of(b->bodies.assembly.scene);
    s->gamma = gamma;
    s->gamma_clear = gamma_clear;
    return IMP_SUCCESS;
}

imp_code imp_builder_parameter(imp_builder *b, const char *name, double lo, double hi,
                               imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (name == NULL) return error_set(error, IMP_ERROR_USAGE, "parameter: the name is NULL");
    const place at = place_argument(NULL, "parameter");
    const fp_environment environment = fp_environment_enter();
    code = scene_bodies_parameter(&b->bodies, name, lo, hi, &at);
    fp_environment_leave(&environment);
    return code;
}

/* --- Bodies ----------------------------------------------------------------------------------- */

imp_code imp_builder_body(imp_builder *b, const char *name, size_t *body, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code != IMP_SUCCESS) return code;
    const size_t index = b->bodies.assembly.count;
    const place at = place_argument(NULL, "name");
    code = scene_bodies_begin(&b->bodies, name, &at);
    if (code == IMP_SUCCESS && body != NULL) *body = index;
    return code;
}

imp_code imp_builder_bodies_of(imp_builder *b, const imp_scene *scene, imp_error *error)
{
    const imp_code code = builder_enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (scene == NULL) return error_set(error, IMP_ERROR_USAGE, "the scene is NULL");
    if (b->bodies.assembly.count > 0 || scene_parameters_of(b->bodies.assembly.scene)->count > 0)
        return error_set(error, IMP_ERROR_USAGE,
                         "the builder has bodies or parameters already; must be taken first");
    if (scene_registry(scene) != b->registry)
        return error_set(error, IMP_ERROR_USAGE,
                         "the scene is of another registry than the builder");
    if (imp_scene_parameter_count(scene) > 0)
        return error_set(error, IMP_ERROR_USAGE,
                         "the scene has parameters; must be a scene without");
    const place at = place_argument(NULL, "scene");
    return scene_bodies_copy(&b->bodies, scene, &at);
}

imp_code imp_builder_solid(imp_builder *b, size_t body, bool solid, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code == IMP_SUCCESS) scene_set_solid(b->bodies.assembly.scene, body, solid);
    return code;
}

/* --- Relations -------------------------------------------------------------------------------- */

imp_code imp_builder_parent(imp_builder *b, size_t body, size_t parent, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, parent, error);
    if (code == IMP_SUCCESS) b->bodies.assembly.bodies[body].parent = parent;
    return code;
}

imp_code imp_builder_group(imp_builder *b, size_t body, const char *group, imp_error *error)
{
    imp_code code = builder_enter(b, error);
    if (code == IMP_SUCCESS) code = builder_check_body(b, body, error);
    if (code != IMP_SUCCESS) return code;
    if (group == NULL) return error_set(error, IMP_ERROR_USAGE, "group: the name is NULL");
    const body_words words = builder_body_words(b, body);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, "group");
    return scene_bodies_join(&b->bodies, body, group, &at);
}

imp_code imp_builder_ignore(imp_builder *b, const char *x, const char *y, imp_error *error)
{
    const imp_code code = builder_enter(b, error);
    if (code != IMP_SUCCESS) return code;
    if (x == NULL || y == NULL) return error_set(error, IMP_ERROR_USAGE, "ignore: a name is NULL");
    const place at = place_argument(NULL, "ignore");
    return scene_bodies_ignore(&b->bodies, x, &at, y, &at);
}

/* --- Done ------------------------------------------------------------------------------------- */

/* There is a body, and none is its own ancestor. */
static imp_code check_all(const imp_builder *b, imp_error *error)
{
    const assembly *a = &b->bodies.assembly;
    if (a->count == 0) return error_set(error, IMP_ERROR_SCENE, "the scene has no bodies");
    size_t body = 0;
    const assembly_search search = assembly_find_cycle(a, &body);
    if (search == ASSEMBLY_NO_CYCLE) return IMP_SUCCESS;
    if (search == ASSEMBLY_NO_MEMORY) return error_set_memory(error);
    const body_words words = builder_body_words(b, body);
    const place whole = place_argument(NULL, words.at), at = place_argument(&whole, "parent");
    return scene_bodies_refuse_cycle(&b->bodies, body, &at);
}

static FP_APART imp_scene *finish(imp_builder *b, imp_error *error)
{
    if (builder_enter(b, error) != IMP_SUCCESS || check_all(b, error) != IMP_SUCCESS) return NULL;
    const place at = place_argument(NULL, "scene");
    b->finished = true;
    return scene_bodies_finish(&b->bodies, &at);
}

imp_scene *imp_builder_finish(imp_builder *b, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    imp_scene *scene = finish(b, error);
    fp_environment_leave(&environment);
    return scene;
}
