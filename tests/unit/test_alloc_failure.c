/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>
#include <sys/stat.h>

#include "core/plugin/parameters.h"
#include "tests/support/alloc_failure.h"
#include "tests/support/kit_registry.h"
#include "tests/support/suite.h"

/* Whatever allocation fails, what was begun is undone and the answer says so. */

#define ATTEMPTS 10000 /* more than any of these allocate: the loops end by themselves */

static imp_error error;

static void assert_nothing_left(size_t before, size_t n)
{
    ck_assert_msg(alloc_failure_live() == before, "failing allocation %zu leaves %zd blocks", n,
                  (ssize_t)(alloc_failure_live() - before));
}

static imp_registry *scan(const sandbox *box)
{
    search_path path = {.count = 0};
    imp_registry *registry =
        search_path_add(&path, box->path, true) ? registry_scan(&path, 0) : NULL;
    search_path_clear(&path);
    return registry;
}

/* A cache that no other suite writes to: what it forgot would be tried again, in a child that fails
 * too. */
static void keep_trials_apart(void)
{
    const char *cache = getenv("XDG_CACHE_HOME");
    char own[4096];
    if (cache != NULL) mkdir(cache, 0700);
    snprintf(own, sizeof own, "%s/alloc_failure", cache != NULL ? cache : "/nonexistent");
    setenv("XDG_CACHE_HOME", own, 1);
}

START_TEST(a_registry_is_whole_or_not_there)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "kit", "a.so");
    sandbox_link(&box, "half_bad", "b.so");
    sandbox_link(&box, "twin", "c.so");
    sandbox_link(&box, "no_entry", "d.so");
    sandbox_link(&box, "bad_parameter_table", "e.so");
    keep_trials_apart();
    imp_registry_free(scan(&box)); /* from here on all trials are known */
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        alloc_failure_begin(++n);
        imp_registry *registry = scan(&box);
        failed = alloc_failure_end();
        bool whole = registry != NULL;
        ck_assert_msg(whole != failed, "failing allocation %zu", n);
        imp_registry_free(registry);
        assert_nothing_left(before, n);
    }
    ck_assert_uint_gt(n, 50);
    sandbox_remove(&box);
}
END_TEST

START_TEST(the_search_path_is_whole_or_refused)
{
    setenv("IMPINGE_PLUGIN_PATH", "/one:/two:/three:/four", 1);
    setenv("XDG_DATA_HOME", "/data", 1);
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        search_path path = {.count = 0};
        alloc_failure_begin(++n);
        bool good = search_path_add_defaults(&path, "/five:/six");
        failed = alloc_failure_end();
        ck_assert(good != failed);
        search_path_clear(&path);
        assert_nothing_left(before, n);
    }
}
END_TEST

#define PLENTY                                                                                     \
    "{\"define\":{\"ball\":[{\"type\":\"kit\",\"radius\":2}],\"up\":[{\"type\":\"nudge\",\"by\":"  \
    "[0,1,0]}]},\"bodies\":[{\"name\":\"a\",\"group\":[\"g\"],\"surfaces\":[{\"type\":\"kit\","    \
    "\"radius\":1,\"points\":[[1,2,3],[4,5,6],[7,8,9]],\"constants\":{\"a\":1,\"b\":2},"           \
    "\"label\":\"x\",\"maps\":[{\"type\":\"nudge\",\"by\":[1,0,0]}]}]},{\"surfaces\":[\"ball\"],"  \
    "\"parent\":\"a\",\"maps\":[\"up\",\"up\"]},{\"group\":\"g\",\"surfaces\":[\"ball\"]}],"       \
    "\"ignore\":[[\"a\",\"body1\"],[\"g\",\"g\"]],\"time\":[0,2]}"

static void assert_refused(imp_code code, size_t n)
{
    ck_assert_msg(code == IMP_ERROR_MEMORY, "allocation %zu: %s", n, error.text);
}

typedef imp_scene *(*scene_maker)(imp_registry *registry);

static void scenes_are_whole_or_not_there(scene_maker make)
{
    imp_registry *registry = kit_registry();
    alloc_failure_begin(0);
    imp_scene_free(make(registry));
    alloc_failure_end();
    size_t before = alloc_failure_live(), n = 0;
    for (bool failed = true; failed && n < ATTEMPTS;) {
        alloc_failure_begin(++n);
        imp_scene *scene = make(registry);
        failed = alloc_failure_end();
        ck_assert_msg((scene == NULL) == failed, "failing allocation %zu: %s", n, error.text);
        if (failed) assert_refused(error.code, n);
        imp_scene_free(scene);
        assert_nothing_left(before, n);
    }
    ck_assert_uint_gt(n, 50);
    imp_registry_free(registry);
}

static imp_scene *plenty(imp_registry *registry)
{
    return imp_scene_from_json(registry, PLENTY, strlen(PLENTY), "s", &error);
}

START_TEST(a_scene_is_whole_or_not_there) { scenes_are_whole_or_not_there(plenty); }
END_TEST

static const char *const
    nudged_a = "kit radius=1 center=1,2,3 label=sin(u) constants={\"a\":1} ! nudge by=1,0,0",
    *const nudged_b = "kit radius=.5 weights=.5,.25 label=\"x\" ! nudge by=0,.5,0 ! nudge by=1,1,1";

static imp_scene *nudged_pair(imp_registry *registry)
{
    return imp_scene_from_pair(registry, nudged_a, nudged_b, &error);
}

static imp_scene *written_pair(imp_registry *registry)
{
    char *text = imp_pair_to_json(registry, nudged_a, nudged_b, &error);
    imp_scene *scene =
        text != NULL ? imp_scene_from_json(registry, text, strlen(text), "pair", &error) : NULL;
    free(text);
    return scene;
}

START_TEST(a_pair_is_whole_or_not_there) { scenes_are_whole_or_not_there(nudged_pair); }
END_TEST

START_TEST(a_pair_s_text_is_whole_or_not_there) { scenes_are_whole_or_not_there(written_pair); }
END_TEST

/* The scene of PLENTY, nearly, without text. */
static imp_code put_in(imp_builder *b)
{
    static const double points[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9}, by[3] = {0, 1, 0};
    const imp_argument shape[] = {imp_argument_number("radius", 1),
                                  imp_argument_rows("points", points, 3, 3),
                                  imp_argument_text("label", "x")};
    const imp_argument nudge = imp_argument_list("by", by, 3);
    size_t first, second;
    imp_code code = imp_builder_time(b, 0, 2, &error);
    if (code == IMP_SUCCESS) code = imp_builder_body(b, "a", &first, &error);
    if (code == IMP_SUCCESS) code = imp_builder_surface(b, first, "kit", shape, 3, &error);
    if (code == IMP_SUCCESS)
        code = imp_builder_surface_map(b, first, 0, "nudge", &nudge, 1, &error);
    if (code == IMP_SUCCESS) code = imp_builder_group(b, first, "g", &error);
    if (code == IMP_SUCCESS) code = imp_builder_body(b, NULL, &second, &error);
    if (code == IMP_SUCCESS) code = imp_builder_surface(b, second, "kit", shape, 1, &error);
    if (code == IMP_SUCCESS) code = imp_builder_map(b, second, "nudge", &nudge, 1, &error);
    if (code == IMP_SUCCESS) code = imp_builder_parent(b, second, first, &error);
    return code == IMP_SUCCESS ? imp_builder_ignore(b, "g", "body1", &error) : code;
}

static imp_scene *built(imp_registry *registry)
{
    imp_builder *b = imp_builder_new(registry);
    error.code = IMP_ERROR_MEMORY; /* which imp_builder_new has no place to say */
    const bool good = b != NULL && put_in(b) == IMP_SUCCESS;
    imp_scene *scene = good ? imp_builder_finish(b, &error) : NULL;
    imp_builder_free(b);
    return scene;
}

START_TEST(a_scene_built_without_text_is_whole_or_not_there)
{
    scenes_are_whole_or_not_there(built);
}
END_TEST

/* Two bodies, begun with those of the scene before. */
static imp_scene *built_of_another(imp_registry *registry)
{
    imp_scene *before = built(registry);
    if (before == NULL) return NULL;
    imp_builder *b = imp_builder_new(registry);
    error.code = IMP_ERROR_MEMORY;
    const bool good = b != NULL && imp_builder_bodies_of(b, before, &error) == IMP_SUCCESS;
    imp_scene *scene = good ? imp_builder_finish(b, &error) : NULL;
    imp_builder_free(b);
    imp_scene_free(before);
    return scene;
}

START_TEST(a_scene_begun_with_another_s_bodies_is_whole_or_not_there)
{
    scenes_are_whole_or_not_there(built_of_another);
}
END_TEST

#ifdef HAVE_ZLIB
#define ARCHIVE "deflated"
#else
#define ARCHIVE "stored"
#endif

static char archive_text[700];

static imp_scene *of_archive(imp_registry *registry)
{
    return imp_scene_from_json(registry, archive_text, strlen(archive_text), "s", &error);
}

/* The archive is a seed of tests/fuzz/array.c, but for its first byte. */
START_TEST(a_scene_of_an_archive_s_array_is_whole_or_not_there)
{
    static char bytes[1000], seed[400];
    sandbox box = sandbox_new();
    const char *const top = getenv("top_srcdir");
    snprintf(seed, sizeof seed, "%s/tests/fuzz/array.d/%s", top != NULL ? top : ".", ARCHIVE);
    FILE *file = fopen(seed, "rb");
    ck_assert_ptr_nonnull(file);
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    sandbox_write(&box, "a.npz", bytes + 1, length - 1);
    snprintf(archive_text, sizeof archive_text,
             "{\"bodies\":[{\"surfaces\":[{\"type\":\"kit\",\"radius\":1,\"points\":{\"file\":"
             "\"%s\",\"array\":\"a\"}}]}]}",
             sandbox_file(&box, "a.npz").at);
    scenes_are_whole_or_not_there(of_archive);
    sandbox_remove(&box);
}
END_TEST

START_TEST(a_file_that_does_not_fit_into_memory_is_told)
{
    imp_registry *registry = kit_registry();
    sandbox box = sandbox_new();
    sandbox_write(&box, "s.json", PLENTY, strlen(PLENTY));
    size_t before = alloc_failure_live();
    alloc_failure_begin(1);
    ck_assert_ptr_null(imp_scene_from_file(registry, sandbox_file(&box, "s.json").at, &error));
    ck_assert(alloc_failure_end());
    ck_assert_int_eq(error.code, IMP_ERROR_MEMORY);
    assert_nothing_left(before, 1);
    sandbox_remove(&box);
    imp_registry_free(registry);
}
END_TEST

SUITE_MAIN("alloc_failure", a_registry_is_whole_or_not_there, the_search_path_is_whole_or_refused,
           a_scene_is_whole_or_not_there, a_pair_is_whole_or_not_there,
           a_pair_s_text_is_whole_or_not_there, a_scene_built_without_text_is_whole_or_not_there,
           a_scene_begun_with_another_s_bodies_is_whole_or_not_there,
           a_scene_of_an_archive_s_array_is_whole_or_not_there,
           a_file_that_does_not_fit_into_memory_is_told)
