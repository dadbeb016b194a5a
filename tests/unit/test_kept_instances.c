/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <pthread.h>
#include <stdatomic.h>

#define IMPINGE_PLUGIN_SYMBOL blot_plugin
#include <impinge/plugin.h>

#include "core/plugin/kept_instances.h"
#include "core/scene/scene.h"
#include "tests/plugins/tiny.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

/* Instances of files that a registry keeps for later scenes. The type below takes a file, which it
 * does not read, and counts how often it is created. */

/* --- The plugin ------------------------------------------------------------------------------- */

enum { BLOT_FILE, BLOT_NUMBER, BLOT_MOOD, BLOT_ROWS };

static const imp_parameter parameters[BLOT_ROWS] = {
    [BLOT_FILE] = IMP_ROW_FILE("file", IMP_PARAMETER_OPTIONAL, "any"),
    [BLOT_NUMBER] = IMP_ROW_NUMBER("number", "1", "0", "any"),
    [BLOT_MOOD] = IMP_ROW_STRING("mood", "\"same\"", 0, "same, other or switch"),
};

static _Atomic(int) created, living;
static const char *switched; /* link that the mood "switch" changes while create runs */

static void point_to(const char *link, const char *file)
{
    remove(link);
    ck_assert_int_eq(symlink(file, link), 0);
}

#define OLD_FILE "/bin/sh"
#define OTHER_OLD_FILE "/etc/passwd"

static imp_status blot_create(const imp_value *values, void **self, imp_create_error *why)
{
    const char *mood = values[BLOT_MOOD].string[0];
    created += 1;
    living += 1;
    if (strcmp(mood, "other") != 0) imp_repeatable(why);
    if (strcmp(mood, "switch") == 0) point_to(switched, OTHER_OLD_FILE);
    return tiny_create(values, self, why);
}

static void blot_destroy(void *self)
{
    (void)self;
    living -= 1;
}

static const imp_surface_type blot = {.struct_size = sizeof(imp_surface_type),
                                      .parameter_count = BLOT_ROWS,
                                      .parameter_size = sizeof(imp_parameter),
                                      .name = "blot",
                                      .summary = "a point",
                                      .equation = "(0, 0, 0)",
                                      .example = "blot",
                                      .parameters = parameters,
                                      .create = blot_create,
                                      .destroy = blot_destroy,
                                      .domain = tiny_domain,
                                      .eval = tiny_eval,
                                      .rate = tiny_rate};
TINY_PLUGIN("blot", blot);

/* --- Tests ------------------------------------------------------------------------------------ */

static imp_error error;

static imp_registry *begin(void)
{
    imp_registry *registry = imp_registry_open(NULL, IMP_REGISTRY_ONLY_PATH);
    ck_assert_int_eq(imp_registry_add(registry, &blot_plugin, &error), IMP_SUCCESS);
    created = living = 0;
    return registry;
}

static imp_scene *scene_of(imp_registry *registry, const char *a, const char *b)
{
    imp_scene *scene = imp_scene_from_pair(registry, a, b, &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

/* Makes and frees a scene whose first surface is this one. */
static void use(imp_registry *registry, const char *line)
{
    imp_scene_free(scene_of(registry, line, "blot"));
}

/* Counts how often the type is created for the file of two scenes, one after the other. */
static int creations(imp_registry *registry, const char *first, const char *second)
{
    created = 0;
    use(registry, first);
    use(registry, second);
    return created - 2; /* those of the blot without a file */
}

START_TEST(a_file_of_later_scenes_is_read_once)
{
    imp_registry *registry = begin();
    imp_scene *first = scene_of(registry, "blot file=" OLD_FILE, "blot");
    imp_scene *second = scene_of(registry, "blot file=" OLD_FILE, "blot");
    ck_assert_ptr_eq(surface_origin(scene_surface(first, 0, 0), 0),
                     surface_origin(scene_surface(second, 0, 0), 0));
    imp_scene_free(first);
    const uint64_t bytes = scene_bytes(second);
    imp_scene_free(second);
    imp_scene *third = scene_of(registry, "blot file=" OLD_FILE, "blot");
    ck_assert_int_eq(created, 4); /* the file's, and each scene's other one */
    ck_assert_int_eq(living, 2);
    ck_assert_uint_eq(scene_bytes(third), bytes); /* though another scene shared it */
    imp_scene_free(third);
    ck_assert_int_eq(living, 1);
    imp_registry_free(registry);
    ck_assert_int_eq(living, 0);
}
END_TEST

START_TEST(a_scene_counts_the_same_bytes_whether_its_file_was_kept_or_not)
{
    imp_registry *registry = begin();
    imp_scene *made = scene_of(registry, "blot file=" OLD_FILE, "blot file=" OLD_FILE);
    const uint64_t bytes = scene_bytes(made);
    ck_assert_uint_gt(bytes, 10000); /* the file's among them */
    imp_scene_free(made);
    imp_scene *found = scene_of(registry, "blot file=" OLD_FILE, "blot file=" OLD_FILE);
    ck_assert_int_eq(created, 1);
    ck_assert_uint_eq(scene_bytes(found), bytes);
    imp_scene_free(found);
    imp_registry_free(registry);
}
END_TEST

START_TEST(what_differs_is_made_anew)
{
    imp_registry *registry = begin();
    const char *const file = "blot file=" OLD_FILE;
    ck_assert_int_eq(creations(registry, file, file), 1);
    ck_assert_int_eq(creations(registry, file, "blot number=0 file=" OLD_FILE), 1);
    ck_assert_int_eq(creations(registry, file, "blot number=2 file=" OLD_FILE), 1);
    ck_assert_int_eq(creations(registry, file, "blot number=-0.0 file=" OLD_FILE), 1);
    ck_assert_int_eq(creations(registry, file, "blot file=/bin/../bin/sh"), 1);
    ck_assert_int_eq(creations(registry, file, file), 0);
    const char *const other = "blot mood=other file=" OLD_FILE; /* has other sources */
    ck_assert_int_eq(creations(registry, other, other), 2);
    ck_assert_int_eq(creations(registry, "blot", "blot number=1"), 2);
    ck_assert_int_eq(creations(registry, "blot file=/dev/null", "blot file=/dev/null"), 2);
    ck_assert_int_eq(creations(registry, "blot file=/none/such", "blot file=/none/such"), 2);
    imp_registry_free(registry);
    ck_assert_int_eq(living, 0);
}
END_TEST

START_TEST(a_file_that_changes_is_read_again)
{
    imp_registry *registry = begin();
    sandbox box = sandbox_new();
    const sandbox_path fresh = sandbox_file(&box, "fresh"), link = sandbox_file(&box, "link");
    char line[600];
    sandbox_write(&box, "fresh", "1", 1); /* the next change may have the same time */
    snprintf(line, sizeof line, "blot file=%s", fresh.at);
    ck_assert_int_eq(creations(registry, line, line), 2);
    snprintf(line, sizeof line, "blot file=%s", link.at);
    point_to(link.at, OLD_FILE);
    ck_assert_int_eq(creations(registry, line, line), 1);
    point_to(link.at, OTHER_OLD_FILE);
    ck_assert_int_eq(creations(registry, line, line), 1);
    point_to(link.at, OLD_FILE);
    ck_assert_int_eq(creations(registry, line, line), 0);
    snprintf(line, sizeof line, "blot mood=switch file=%s", link.at);
    switched = link.at;
    created = 0;
    use(registry, line); /* its file changes while it is created */
    point_to(link.at, OLD_FILE);
    use(registry, line);
    ck_assert_int_eq(created, 4);
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(what_is_isolated_is_not_shared_with_other_scenes)
{
    imp_registry *registry = begin();
    use(registry, "blot file=" OLD_FILE);
    ck_assert_int_eq(imp_registry_isolate(registry, "blot", &error), IMP_SUCCESS);
    imp_scene *first = scene_of(registry, "blot file=" OLD_FILE, "blot");
    imp_scene *second = scene_of(registry, "blot file=" OLD_FILE, "blot");
    ck_assert_ptr_ne(surface_origin(scene_surface(first, 0, 0), 0),
                     surface_origin(scene_surface(second, 0, 0), 0));
    ck_assert_int_eq(created, 2); /* all later ones in another process */
    imp_scene_free(first);
    imp_scene_free(second);
    imp_registry_free(registry);
}
END_TEST

START_TEST(only_so_many_are_kept_and_only_for_so_long)
{
    imp_registry *registry = begin();
    char line[200];
    for (int k = 0; k < KEPT_MAX + 20; ++k) {
        snprintf(line, sizeof line, "blot number=%d file=" OLD_FILE, k);
        use(registry, line);
    }
    ck_assert_int_eq(living, KEPT_MAX);
    created = 0;
    use(registry, line);
    ck_assert_int_eq(created, 1); /* the last one is there */
    use(registry, "blot number=0 file=" OLD_FILE);
    ck_assert_int_eq(created, 3); /* the first one is not */
    for (int k = 0; k < KEPT_UNUSED_MAX + KEPT_MAX + 2; ++k) use(registry, line);
    ck_assert_int_eq(living, 1);
    imp_registry_free(registry);
    ck_assert_int_eq(living, 0);
}
END_TEST

static void *use_often(void *registry)
{
    char line[200];
    for (int k = 0; k < 200; ++k) {
        snprintf(line, sizeof line, "blot number=%d file=" OLD_FILE, k % 3);
        imp_error own;
        imp_scene *scene = imp_scene_from_pair(registry, line, "blot file=" OLD_FILE, &own);
        if (scene == NULL) return registry;
        imp_scene_free(scene);
    }
    return NULL;
}

START_TEST(threads_share_what_is_kept)
{
    imp_registry *registry = begin();
    enum { THREADS = 4 };
    pthread_t thread[THREADS];
    for (int k = 0; k < THREADS; ++k)
        ck_assert_int_eq(pthread_create(&thread[k], NULL, use_often, registry), 0);
    for (int k = 0; k < THREADS; ++k) {
        void *failed;
        ck_assert_int_eq(pthread_join(thread[k], &failed), 0);
        ck_assert_ptr_null(failed);
    }
    ck_assert_int_eq(living, 4);
    imp_registry_free(registry);
    ck_assert_int_eq(living, 0);
}
END_TEST

SUITE_MAIN("kept_instances", a_file_of_later_scenes_is_read_once,
           a_scene_counts_the_same_bytes_whether_its_file_was_kept_or_not,
           what_differs_is_made_anew, a_file_that_changes_is_read_again,
           what_is_isolated_is_not_shared_with_other_scenes,
           only_so_many_are_kept_and_only_for_so_long, threads_share_what_is_kept)
