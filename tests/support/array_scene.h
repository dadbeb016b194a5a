/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_ARRAY_SCENE_H
#define TESTS_SUPPORT_ARRAY_SCENE_H

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "tests/support/query_helpers.h"

/* Scenes of which an array of numbers stands in a file.
 *
 * A registry, and an empty file at `path`, which is removed at a test's end. */
static imp_registry *registry;
static imp_error error;
static char path[] = "/tmp/impinge-test-XXXXXX";

static void array_scene_begin(void)
{
    registry = query_registry();
    const int file = mkstemp(path);
    ck_assert_int_ge(file, 0);
    close(file);
}

static void array_scene_end(void)
{
    unlink(path);
    memcpy(path + sizeof path - 7, "XXXXXX", 6);
    imp_registry_free(registry);
}

/* Reads a scene in which a ball moves toward a triangle with these points. NULL: see `error`. */
static imp_scene *array_scene_read(const char *points)
{
    char text[700];
    snprintf(text, sizeof text,
             "{\"bodies\":[{\"surfaces\":[{\"type\":\"triangle\",\"points\":%s}]},{\"surfaces\":[{"
             "\"type\":\"sphere\",\"radius\":0.5,\"center\":[3,0.1,0]}],\"maps\":[{\"type\":"
             "\"translate\",\"velocity\":[-4,0,0]}]}]}",
             points);
    return imp_scene_from_json(registry, text, strlen(text), "scene", &error);
}

/* Solves and frees the scene. */
static imp_result array_scene_solve(imp_scene *scene)
{
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_result result = {.struct_size = sizeof result};
    const imp_options options = imp_options_default(scene);
    ck_assert_int_eq(imp_scene_solve(scene, &options, &result, &error), IMP_SUCCESS);
    imp_scene_free(scene);
    return result;
}

#endif
