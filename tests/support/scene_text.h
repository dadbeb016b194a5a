/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SCENE_TEXT_H
#define TESTS_SUPPORT_SCENE_TEXT_H

#include "core/scene/scene.h"
#include "tests/support/kit_registry.h"
#include "tests/support/suite.h"

/* Scenes from text, of the type and the map of tests/plugins/kit.c. */

static imp_registry *registry;
static imp_error error;

/* Single quotes for double ones: scenes are easier to read so. */
static inline imp_scene *read_scene(const char *quoted)
{
    if (registry == NULL) registry = kit_registry();
    size_t length = strlen(quoted);
    char *text = malloc(length + 1);
    for (size_t i = 0; i <= length; ++i) text[i] = quoted[i] == '\'' ? '"' : quoted[i];
    error = (imp_error){IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_json(registry, text, length, "s.json", &error);
    ck_assert((scene == NULL) == (error.code != IMP_SUCCESS));
    free(text);
    return scene;
}

static inline imp_scene *read_good(const char *quoted)
{
    imp_scene *scene = read_scene(quoted);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static inline void assert_refused(const char *quoted, imp_code code, const char *message)
{
    imp_scene *scene = read_scene(quoted);
    ck_assert_ptr_null(scene);
    ck_assert_int_eq(error.code, code);
    ck_assert_str_eq(error.text, message);
}

static inline void assert_wrong(const char *quoted, const char *message)
{
    assert_refused(quoted, IMP_ERROR_SCENE, message);
}

/* The point the surface shows. */
static inline void assert_point(const imp_scene *scene, size_t body, size_t index, double x,
                                double y, double z)
{
    double p[3] = {0, 0, 0}, found[3];
    ck_assert_int_eq(imp_scene_eval(scene, body, index, 1, p, found, NULL, &error), IMP_SUCCESS);
    ck_assert_double_eq(found[0], x);
    ck_assert_double_eq(found[1], y);
    ck_assert_double_eq(found[2], z);
}

#define KIT "{'type':'kit','radius':1}"
#define BODY "{'surfaces':[" KIT "]}"
#define SCENE(MORE) "{'bodies':[" BODY "," BODY "]" MORE "}"

#endif
