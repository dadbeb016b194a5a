/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/common/capabilities.h"
#include "core/plugin/registry.h"
#include "tests/support/sandbox.h"
#include "tests/support/suite.h"

/* Scans directories named in a colon-separated list, and no others. */
static imp_registry *scan(const char *list, bool named)
{
    search_path path = {.count = 0};
    ck_assert(search_path_add(&path, list, named));
    imp_registry *registry = registry_scan(&path, 0);
    ck_assert_ptr_nonnull(registry);
    search_path_clear(&path);
    return registry;
}

static size_t count_types(const imp_registry *registry)
{
    imp_type_info info;
    size_t n = 0;
    while (imp_registry_type(registry, n, &info)) ++n;
    return n;
}

static size_t count_refusals(const imp_registry *registry)
{
    imp_plugin_refusal refusal;
    size_t n = 0;
    while (imp_registry_refusal(registry, n, &refusal)) ++n;
    return n;
}

static void assert_refusal(const imp_registry *registry, size_t index, const char *file,
                           const char *reason)
{
    imp_plugin_refusal refusal;
    ck_assert(imp_registry_refusal(registry, index, &refusal));
    ck_assert_msg(strstr(refusal.file, file) != NULL, "%s: %s", refusal.file, refusal.reason);
    ck_assert_msg(strstr(refusal.reason, reason) != NULL, "%s: %s", refusal.file, refusal.reason);
}

/* A directory with this one plugin is refused, for this reason. */
static void assert_alone_refused(const char *plugin, const char *reason)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, plugin, "p.so");
    imp_registry *registry = scan(box.path, true);
    ck_assert_uint_eq(count_types(registry), 0);
    ck_assert_uint_eq(count_refusals(registry), 1);
    assert_refusal(registry, 0, "/p.so", reason);
    imp_registry_free(registry);
    sandbox_remove(&box);
}

START_TEST(a_plugin_offers_its_types_with_all_they_say)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "kit", "p.so");
    imp_registry *registry = scan(box.path, true);
    imp_type_info info;
    ck_assert_uint_eq(count_refusals(registry), 0);
    ck_assert_uint_eq(count_types(registry), 2);
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_int_eq(info.kind, IMP_TYPE_SURFACE);
    ck_assert_str_eq(info.name, "kit");
    ck_assert_str_eq(info.plugin, "kit");
    ck_assert_str_eq(info.version, "1.0");
    ck_assert_str_eq(info.license, "Apache-2.0");
    ck_assert_str_eq(info.author, "tests");
    ck_assert_str_eq(info.parameters[0].name, "radius");
    ck_assert_int_eq(info.file[0], '/');
    ck_assert_ptr_null(info.shadowed_by);
    ck_assert(imp_registry_type(registry, 1, &info));
    ck_assert_int_eq(info.kind, IMP_TYPE_MAP);
    ck_assert_str_eq(info.name, "nudge");
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(types_are_found_by_sort_and_name)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "kit", "p.so");
    imp_registry *registry = scan(box.path, true);
    ck_assert_str_eq(registry_find_surface(registry, "kit")->name, "kit");
    ck_assert_str_eq(registry_find_map(registry, "nudge")->name, "nudge");
    ck_assert_ptr_null(registry_find_surface(registry, "nudge"));
    ck_assert_ptr_null(registry_find_map(registry, "kit"));
    ck_assert_ptr_null(registry_find_file(registry, IMP_TYPE_MAP, "kit"));
    ck_assert_str_eq(registry_nearest(registry, IMP_TYPE_SURFACE, "kti"), "kit");
    ck_assert_str_eq(registry_nearest(registry, IMP_TYPE_MAP, "Nudge"), "nudge");
    ck_assert_ptr_null(registry_nearest(registry, IMP_TYPE_SURFACE, "nudge"));
    ck_assert_ptr_null(registry_nearest(registry, IMP_TYPE_SURFACE, ""));
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(files_are_taken_in_bytewise_order_and_only_those_ending_in_so)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "twin", "b.so");
    sandbox_link(&box, "kit", "B.so");
    sandbox_link(&box, "create_null", ".hidden.so");
    sandbox_link(&box, "create_fails", "p.so.1");
    sandbox_write(&box, "readme.txt", "no", 2);
    sandbox_link(&box, "fast_math", ".so");
    imp_registry *registry = scan(box.path, true);
    imp_type_info info;
    ck_assert_uint_eq(count_types(registry), 3);
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_str_eq(info.plugin, "kit");
    ck_assert(imp_registry_type(registry, 2, &info));
    ck_assert_str_eq(info.plugin, "twin");
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(the_first_type_of_a_name_wins_and_the_later_one_says_who_shadows_it)
{
    sandbox first = sandbox_new(), second = sandbox_new();
    sandbox_link(&first, "twin", "z.so");
    sandbox_link(&second, "kit", "a.so");
    sandbox_path list;
    snprintf(list.at, sizeof list.at, "%s:%s", first.path, second.path);
    imp_registry *registry = scan(list.at, true);
    imp_type_info info;
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_str_eq(info.plugin, "twin");
    ck_assert_ptr_null(info.shadowed_by);
    ck_assert(imp_registry_type(registry, 1, &info));
    ck_assert_str_eq(info.plugin, "kit");
    ck_assert_ptr_nonnull(strstr(info.shadowed_by, "/z.so"));
    ck_assert_ptr_nonnull(strstr(registry_find_file(registry, IMP_TYPE_SURFACE, "kit"), "/z.so"));
    ck_assert(imp_registry_type(registry, 2, &info)); /* the map is not shadowed */
    ck_assert_ptr_null(info.shadowed_by);
    imp_registry_free(registry);
    sandbox_remove(&first);
    sandbox_remove(&second);
}
END_TEST

START_TEST(a_file_reached_twice_is_loaded_once_and_refused_once)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "twin", "a.so");
    sandbox_link(&box, "twin", "b.so");
    sandbox_link(&box, "no_entry", "c.so");
    sandbox_link(&box, "no_entry", "d.so");
    sandbox_path list;
    snprintf(list.at, sizeof list.at, "%s:%s/.", box.path, box.path);
    imp_registry *registry = scan(list.at, true);
    ck_assert_uint_eq(count_types(registry), 1);
    ck_assert_uint_eq(count_refusals(registry), 1);
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(a_missing_directory_is_reported_only_if_it_was_named)
{
    imp_registry *registry = scan("/nonexistent/impinge", false);
    ck_assert_uint_eq(count_refusals(registry), 0);
    imp_registry_free(registry);
    registry = scan("::/nonexistent/impinge:", true);
    ck_assert_uint_eq(count_refusals(registry), 1);
    assert_refusal(registry, 0, "/nonexistent/impinge", "no such directory");
    imp_registry_free(registry);
    registry = scan("/dev/null", false);
    assert_refusal(registry, 0, "/dev/null", "Not a directory");
    imp_registry_free(registry);
}
END_TEST

START_TEST(relative_directories_give_absolute_paths)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "twin", "p.so");
    ck_assert_int_eq(chdir(box.path), 0);
    imp_registry *registry = scan(".", true);
    imp_type_info info;
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_int_eq(info.file[0], '/');
    imp_registry_free(registry);
    ck_assert_int_eq(chdir("/"), 0);
    sandbox_remove(&box);
}
END_TEST

START_TEST(links_that_lead_nowhere_or_in_circles_are_refused)
{
    sandbox box = sandbox_new();
    ck_assert_int_eq(symlink("loop.so", sandbox_file(&box, "loop.so").at), 0);
    ck_assert_int_eq(symlink("/nonexistent", sandbox_file(&box, "gone.so").at), 0);
    ck_assert_int_eq(mkdir(sandbox_file(&box, "dir.so").at, 0700), 0);
    imp_registry *registry = scan(box.path, true);
    ck_assert_uint_eq(count_refusals(registry), 3);
    assert_refusal(registry, 0, "/dir.so", "directory");
    assert_refusal(registry, 1, "/gone.so", "No such file");
    assert_refusal(registry, 2, "/loop.so", "symbolic links");
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(each_sin_of_a_plugin_is_refused_by_its_name)
{
    assert_alone_refused("no_entry", "entry: does not export the symbol impinge_plugin");
    assert_alone_refused("no_note", "note: has no Impinge note");
    assert_alone_refused("wrong_abi_major", "abi: abi_major is 9, the host's is 1");
    assert_alone_refused("newer_minor", "abi: abi_minor is 77, the host's is 0");
    assert_alone_refused("note_disagrees", "says note_disagrees 2.0, ABI 1.0, but the note");
    assert_alone_refused("null_string", "author is NULL; must be a line of text");
    assert_alone_refused("no_factory", "offers no types");
    assert_alone_refused("null_callback", "null_callback: eval is NULL");
    assert_alone_refused("bad_name", "a type's name is 'bad name!'");
    assert_alone_refused("bad_parameter_table",
                         "bad_parameter_table: radius: default_value: got -1, must be > 0");
    assert_alone_refused("bad_parts", "bad_parts: parts name '$ofset', which must be a parameter");
    assert_alone_refused("half_bad", "half_bad: create is NULL");
    assert_alone_refused("undefined_symbol", "nobody_defines_this");
}
END_TEST

/* Whether subnormals are kept and rounding is to nearest, by doing it. */
static void assert_arithmetic_is_whole(void)
{
    volatile double tiny = 0x1p-1074, one = 1;
    ck_assert(tiny * one > 0);
    ck_assert(tiny / 2 == 0);
    ck_assert(one + 0x1p-54 == one);
    ck_assert(one - 0x1p-55 == one);
}

START_TEST(a_plugin_that_changes_the_arithmetic_is_refused_and_leaves_no_trace)
{
    fp_mode before = fp_mode_read();
    assert_alone_refused("fp_mode", "mode of arithmetic");
    ck_assert(fp_mode_read() == before);
    assert_arithmetic_is_whole();
}
END_TEST

START_TEST(linking_with_fast_math_never_reaches_the_host)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "fast_math", "p.so");
    fp_mode before = fp_mode_read();
    imp_registry *registry = scan(box.path, true);
    /* some toolchains add the constructor, some do not */
    ck_assert_uint_eq(count_types(registry) + count_refusals(registry), 1);
    ck_assert(fp_mode_read() == before);
    assert_arithmetic_is_whole();
    imp_registry_free(registry);
    ck_assert(fp_mode_read() == before);
    sandbox_remove(&box);
}
END_TEST

START_TEST(one_bad_file_does_not_keep_the_others_out)
{
    sandbox box = sandbox_new();
    sandbox_write(&box, "a.so", "text", 4);
    sandbox_link(&box, "twin", "b.so");
    sandbox_link(&box, "half_bad", "c.so");
    imp_registry *registry = scan(box.path, true);
    ck_assert_uint_eq(count_types(registry), 1);
    ck_assert_uint_eq(count_refusals(registry), 2);
    assert_refusal(registry, 0, "/a.so", "format: is not an ELF file");
    imp_registry_free(registry);
    sandbox_remove(&box);
}
END_TEST

START_TEST(two_registries_live_side_by_side)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "kit", "p.so");
    imp_registry *a = scan(box.path, true), *b = scan(box.path, true);
    imp_registry_free(a);
    ck_assert_str_eq(registry_find_surface(b, "kit")->summary, "a point");
    imp_registry_free(b);
    sandbox_remove(&box);
}
END_TEST

/* Where the i-th directory of a path is; "" past the last. */
static const char *directory(const search_path *path, size_t i)
{
    return i < path->count ? path->directory[i].path : "";
}

START_TEST(the_path_is_argument_then_environment_then_user_then_installed)
{
    search_path path = {.count = 0};
    setenv("IMPINGE_PLUGIN_PATH", "/three", 1);
    setenv("XDG_DATA_HOME", "/data", 1);
    setenv("HOME", "/home/somebody", 1);
    ck_assert(search_path_add_defaults(&path, "/one::/two:"));
    ck_assert_uint_eq(path.count, 5);
    ck_assert_str_eq(directory(&path, 0), "/one");
    ck_assert_str_eq(directory(&path, 1), "/two");
    ck_assert_str_eq(directory(&path, 2), "/three");
    ck_assert_str_eq(directory(&path, 3), "/data/impinge/1");
    ck_assert_str_eq(directory(&path, 4), PLUGINDIR);
    ck_assert(path.directory[2].named && !path.directory[3].named && !path.directory[4].named);
    search_path_clear(&path);
}
END_TEST

START_TEST(the_users_directory_falls_back_to_home_or_is_left_out)
{
    search_path path = {.count = 0};
    unsetenv("IMPINGE_PLUGIN_PATH");
    setenv("XDG_DATA_HOME", "not/absolute", 1);
    setenv("HOME", "/home/somebody", 1);
    ck_assert(search_path_add_defaults(&path, NULL));
    ck_assert_uint_eq(path.count, 2);
    ck_assert_str_eq(directory(&path, 0), "/home/somebody/.local/share/impinge/1");
    search_path_clear(&path);
    unsetenv("XDG_DATA_HOME");
    unsetenv("HOME");
    ck_assert(search_path_add_defaults(&path, NULL));
    ck_assert_uint_eq(path.count, 1);
    search_path_clear(&path);
}
END_TEST

START_TEST(the_public_registry_sees_the_directories_of_its_argument_first)
{
    sandbox box = sandbox_new();
    sandbox_link(&box, "kit", "p.so");
    imp_registry *registry = imp_registry_new(box.path);
    imp_type_info info;
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_str_eq(info.plugin, "kit");
    ck_assert(!imp_registry_type(registry, 100000, &info));
    ck_assert(!imp_registry_type(NULL, 0, &info));
    imp_registry_free(registry);
    imp_registry_free(NULL);
    sandbox_remove(&box);
}
END_TEST

static imp_status no_distance(const void *self, const imp_model point[4], imp_model *distance)
{
    (void)self, (void)point, (void)distance;
    return IMP_STATUS_UNBOUNDED;
}

static imp_status no_pose(const void *self, const imp_model *t, imp_pose *pose)
{
    (void)self, (void)t, (void)pose;
    return IMP_STATUS_UNBOUNDED;
}

START_TEST(a_type_offers_what_its_struct_reaches_and_no_more)
{
    imp_surface_type type = {.struct_size = sizeof type, .distance = no_distance};
    ck_assert(surface_type_offers(&type, CAPABILITY_CORE));
    ck_assert(surface_type_offers(&type, CAPABILITY_DISTANCE));
    ck_assert(!surface_type_offers(&type, CAPABILITY_SYMMETRY));
    ck_assert(!surface_type_offers(&type, CAPABILITY_RIGID));
    ck_assert(!surface_type_offers(NULL, CAPABILITY_CORE));
    type.struct_size = (uint32_t)offsetof(imp_surface_type, symmetry);
    ck_assert(surface_type_offers(&type, CAPABILITY_DISTANCE));
    ck_assert(!IMP_HAS(&type, symmetry));
    type.struct_size -= 1;
    ck_assert(!surface_type_offers(&type, CAPABILITY_DISTANCE));

    imp_map_type map = {.struct_size = sizeof map, .rigid = no_pose};
    ck_assert(map_type_offers(&map, CAPABILITY_RIGID));
    ck_assert(!map_type_offers(&map, CAPABILITY_PIECES));
    map.struct_size = (uint32_t)offsetof(imp_map_type, rigid);
    ck_assert(!map_type_offers(&map, CAPABILITY_RIGID));
}
END_TEST

SUITE_MAIN("registry", a_plugin_offers_its_types_with_all_they_say,
           types_are_found_by_sort_and_name,
           files_are_taken_in_bytewise_order_and_only_those_ending_in_so,
           the_first_type_of_a_name_wins_and_the_later_one_says_who_shadows_it,
           a_file_reached_twice_is_loaded_once_and_refused_once,
           a_missing_directory_is_reported_only_if_it_was_named,
           relative_directories_give_absolute_paths,
           links_that_lead_nowhere_or_in_circles_are_refused,
           each_sin_of_a_plugin_is_refused_by_its_name,
           a_plugin_that_changes_the_arithmetic_is_refused_and_leaves_no_trace,
           linking_with_fast_math_never_reaches_the_host, one_bad_file_does_not_keep_the_others_out,
           two_registries_live_side_by_side,
           the_path_is_argument_then_environment_then_user_then_installed,
           the_users_directory_falls_back_to_home_or_is_left_out,
           the_public_registry_sees_the_directories_of_its_argument_first,
           a_type_offers_what_its_struct_reaches_and_no_more)
