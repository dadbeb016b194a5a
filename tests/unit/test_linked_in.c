/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#define IMPINGE_PLUGIN_SYMBOL blob_plugin
#include <impinge/formula.h>
#include <impinge/plugin.h>

#include "tests/support/alloc_failure.h"
#include "tests/support/query_helpers.h"

/* Plugins that are linked into the program, and handed to a registry. */

/* --- The plugin: a sphere that grows ---------------------------------------------------------- */

static const imp_parameter parameters[] = {
    IMP_ROW_POSITIVE("radius", "length", "1", "at t = 0"),
};

static imp_status blob_create(const imp_value *values, void **self, imp_create_error *why)
{
    (void)why;
    double *radius = malloc(sizeof *radius);
    if (radius == NULL) return IMP_STATUS_INTERNAL;
    *radius = values[0].number[0];
    *self = radius;
    return IMP_STATUS_OK;
}

static void blob_domain(const void *self, double lo[3], double hi[3])
{
    (void)self;
    imp_set_domain(lo, hi, 0, IMP_TWO_PI_UPPER, -2, 2);
}

static void blob_formula(const void *self, imp_model u, imp_model v, imp_model t, imp_model out[3])
{
    const double *radius = self;
    const imp_model r = imp_shift(t, *radius);
    out[0] = imp_mul(r, imp_mul(imp_cos(u), imp_cos(v)));
    out[1] = imp_mul(r, imp_mul(imp_sin(u), imp_cos(v)));
    out[2] = imp_mul(r, imp_sin(v));
}
IMP_SURFACE_FORMULA(blob_formula)

static const imp_surface_type blob = {
    IMP_SURFACE_FIELDS(blob, blob_formula),
    .summary = "sphere that grows",
    .equation = "(radius + t) (cos u cos v, sin u cos v, sin v)",
    .example = "blob",
};
IMPINGE_SURFACE_PLUGIN("blob", "1.0", "MIT", "The Impinge authors", blob);

/* --- Tests ------------------------------------------------------------------------------------ */

static imp_error error;

static imp_registry *nothing_searched(void)
{
    imp_registry *registry = imp_registry_open(NULL, IMP_REGISTRY_ONLY_PATH);
    ck_assert_ptr_nonnull(registry);
    return registry;
}

static size_t count_types(const imp_registry *registry)
{
    imp_type_info info;
    size_t n = 0;
    while (imp_registry_type(registry, n, &info)) ++n;
    return n;
}

static imp_result meet(imp_registry *registry)
{
    imp_scene *scene = imp_scene_from_pair(registry, "blob", "blob radius=2.5", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    const imp_options options = imp_options_default(scene);
    imp_result result = {.struct_size = sizeof result};
    ck_assert_msg(imp_scene_solve(scene, &options, &result, &error) == IMP_SUCCESS, "%s",
                  error.text);
    imp_scene_free(scene);
    return result;
}

START_TEST(a_registry_of_its_path_alone_searches_nothing_else)
{
    setenv("IMPINGE_PLUGIN_PATH", "plugins/.libs", 1);
    imp_registry *registry = nothing_searched();
    ck_assert_uint_eq(count_types(registry), 0);
    imp_registry_free(registry);
    registry = imp_registry_open("/nowhere/at/all", IMP_REGISTRY_ONLY_PATH);
    imp_plugin_refusal refusal;
    ck_assert(imp_registry_refusal(registry, 0, &refusal));
    ck_assert_str_eq(refusal.file, "/nowhere/at/all");
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_plugin_linked_in_offers_its_types_like_any_other)
{
    imp_registry *registry = nothing_searched();
    imp_type_info info;
    ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
    ck_assert_uint_eq(count_types(registry), 1);
    ck_assert(imp_registry_type(registry, 0, &info));
    ck_assert_str_eq(info.name, "blob");
    ck_assert_str_eq(info.file, IMP_LINKED_IN);
    ck_assert_ptr_null(info.shadowed_by);
    ck_assert_int_eq(meet(registry).verdict,
                     IMP_VERDICT_CLEAR); /* one inside the other, 1.5 apart */
    imp_registry_free(registry);
}
END_TEST

START_TEST(a_type_linked_in_is_isolated_like_any_other)
{
    imp_registry *registry = nothing_searched();
    ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_registry_isolate(registry, "blob", &error), IMP_SUCCESS);
    ck_assert_int_eq(meet(registry).verdict, IMP_VERDICT_CLEAR);
    imp_registry_free(registry);
}
END_TEST

START_TEST(what_is_isolated_must_be_the_name_of_a_type)
{
    imp_registry *registry = nothing_searched();
    ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_registry_isolate(registry, "blob,blbo", &error), IMP_ERROR_USAGE);
    ck_assert_str_eq(error.text,
                     "unknown type 'blbo' to isolate, did you mean 'blob'? `impinge list` "
                     "shows what there is");
    ck_assert_int_eq(imp_registry_isolate(registry, "helicoid", &error), IMP_ERROR_USAGE);
    ck_assert_str_eq(error.text,
                     "unknown type 'helicoid' to isolate; `impinge list` shows what there is");
    ck_assert_int_eq(meet(registry).verdict, IMP_VERDICT_CLEAR); /* in this process */
    imp_registry_free(registry);
}
END_TEST

START_TEST(types_found_before_shadow_those_added)
{
    const imp_plugin again = blob_plugin;
    imp_registry *registry = query_registry();
    const size_t found = count_types(registry);
    imp_type_info info;
    ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
    ck_assert_int_eq(imp_registry_add(registry, &again, &error), IMP_SUCCESS);
    ck_assert(imp_registry_type(registry, found, &info) && info.shadowed_by == NULL);
    ck_assert(imp_registry_type(registry, found + 1, &info));
    ck_assert_str_eq(info.shadowed_by, IMP_LINKED_IN);
    imp_registry_free(registry);
}
END_TEST

static void is_refused(const imp_plugin *plugin, const char *why)
{
    imp_registry *registry = nothing_searched();
    ck_assert_int_eq(imp_registry_add(registry, plugin, &error), IMP_ERROR_PLUGIN);
    ck_assert_msg(strstr(error.text, why) != NULL, "%s", error.text);
    ck_assert_int_eq(imp_registry_add(registry, plugin, NULL), IMP_ERROR_PLUGIN);
    ck_assert_uint_eq(count_types(registry), 0);
    imp_registry_free(registry);
}

static const void *no_factory(const char *id)
{
    (void)id;
    return NULL;
}

START_TEST(a_faulty_plugin_adds_nothing_and_says_why)
{
    imp_plugin faulty = blob_plugin;
    faulty.magic = 1;
    is_refused(&faulty, "magic");
    faulty = blob_plugin, faulty.abi_major = 99;
    is_refused(&faulty, "abi_major is 99");
    faulty = blob_plugin, faulty.get_factory = NULL;
    is_refused(&faulty, "get_factory is NULL");
    faulty = blob_plugin, faulty.get_factory = no_factory;
    is_refused(&faulty, "offers no types");
    imp_registry *registry = nothing_searched();
    ck_assert_int_eq(imp_registry_add(NULL, &blob_plugin, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_registry_add(registry, NULL, &error), IMP_ERROR_USAGE);
    imp_registry_free(registry);
}
END_TEST

/* jansson tells a few of its failures as errors of syntax in the default of a parameter. */
START_TEST(a_plugin_that_memory_runs_out_for_is_added_whole_afterwards)
{
    imp_registry *registry = NULL;
    size_t n = 0;
    const size_t before = alloc_failure_live();
    for (bool failed = true; failed && n < 1000; imp_registry_free(registry)) {
        registry = nothing_searched();
        alloc_failure_begin(++n);
        const imp_code code = imp_registry_add(registry, &blob_plugin, &error);
        failed = alloc_failure_end();
        ck_assert_msg((code == IMP_SUCCESS) != failed, "failing allocation %zu: %s", n, error.text);
        if (!failed) continue;
        ck_assert(code == IMP_ERROR_MEMORY || strstr(error.text, "which is not JSON") != NULL);
        ck_assert_uint_eq(count_types(registry), 0);
        ck_assert_int_eq(imp_registry_add(registry, &blob_plugin, &error), IMP_SUCCESS);
        ck_assert_uint_eq(count_types(registry), 1);
    }
    ck_assert_uint_gt(n, 4);
    ck_assert_uint_eq(alloc_failure_live(), before);
}
END_TEST

SUITE_MAIN("linked_in", a_registry_of_its_path_alone_searches_nothing_else,
           a_plugin_linked_in_offers_its_types_like_any_other,
           a_type_linked_in_is_isolated_like_any_other, what_is_isolated_must_be_the_name_of_a_type,
           types_found_before_shadow_those_added, a_faulty_plugin_adds_nothing_and_says_why,
           a_plugin_that_memory_runs_out_for_is_added_whole_afterwards)
