/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "tests/support/built_plugins.h"
#include "tests/support/comma_locale.h"

#include <impinge/examine.h>

/* A program with a locale in which 0.5 is written "0,5": the same texts and answers, and the locale
 * is its own again after every call. */

static void is_comma(const char *after)
{
    ck_assert_msg(strcmp(localeconv()->decimal_point, ",") == 0, "%s changes the locale", after);
}

/* What the call says has this text in it, and no number with a comma. */
static void says(const imp_error *error, const char *wanted)
{
    ck_assert_msg(strstr(error->text, wanted) != NULL, "'%s', wanted '%s'", error->text, wanted);
    is_comma(error->text);
}

static void check_messages(imp_registry *registry)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_ptr_null(imp_scene_from_pair(registry, "sphere radius=-0.5", "sphere", &error));
    says(&error, "got -0.5, must be > 0");
    ck_assert_ptr_null(imp_scene_from_pair(
        registry, "sphere ! keyframes times=0,1 rotations=[[.5,.5,0,0],[1,0,0,0]]", "sphere",
        &error));
    says(&error, "[0.5,0.5,0,0] has length 0.7"); /* a plugin's own text */
    ck_assert_ptr_null(imp_scene_from_pair(
        registry, "formula x=u y=v z=sqrt(-0.5-u*u) domain=[[0,1],[0,1]]", "sphere", &error));
    says(&error, "-0.5]");
    imp_builder *builder = imp_builder_new(registry);
    ck_assert_ptr_nonnull(builder);
    ck_assert_int_ne(imp_builder_time(builder, 1.5, 0.5, &error), IMP_SUCCESS);
    says(&error, "0.5");
    imp_builder_free(builder);
    char *json = imp_stage_to_json(registry, IMP_TYPE_SURFACE, "sphere radius=.5", &error);
    ck_assert_ptr_nonnull(json);
    ck_assert_ptr_nonnull(strstr(json, "\"radius\":0.5"));
    is_comma("imp_stage_to_json");
    free(json);
}

static imp_result answer(imp_registry *registry)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(
        registry,
        "formula x=.5*cos(u)*cos(v) y=.5*sin(u)*cos(v) z=.5*sin(v) domain=[[0,6.5],[-1.6,1.6]]",
        "sphere radius=.25 center=1.5,0,0 ! translate velocity=-1.5,0,0", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    imp_options options = imp_options_default(scene);
    imp_result result = {.struct_size = sizeof result};
    ck_assert_msg(imp_scene_solve(scene, &options, &result, &error) == IMP_SUCCESS, "%s",
                  error.text);
    imp_scene_free(scene);
    return result;
}

START_TEST(texts_have_a_point_in_a_locale_with_a_comma)
{
    const sandbox box = sandbox_new();
    imp_registry *registry = built_registry();
    const imp_result usual = answer(registry);
    ck_assert(comma_locale_make(&box) && setlocale(LC_ALL, COMMA_LOCALE) != NULL);
    is_comma("setlocale");
    check_messages(registry);
    const imp_result result = answer(registry);
    ck_assert(result.verdict == IMP_VERDICT_CONTACT && result.t == usual.t);
    is_comma("imp_scene_solve");
    imp_registry_free(registry);
    comma_locale_remove(&box);
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {texts_have_a_point_in_a_locale_with_a_comma};
    if (comma_locale_can()) return suite_main("locale", tests, 1);
    puts("skipped: localedef cannot make a locale here");
    return 77;
}
