/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <impinge/examine.h>
#include <impinge/formula_text.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/support/built_plugins.h"

/* imp_piece_formula: each stage of a surface as a closed text, with exact numbers. */

static imp_registry *registry;

static void open_registry(void) { registry = built_registry(); }
static void close_registry(void) { imp_registry_free(registry); }

static imp_scene *scene_of(const char *surface)
{
    imp_error error = {IMP_SUCCESS, ""};
    imp_scene *scene = imp_scene_from_pair(registry, surface, "point", &error);
    ck_assert_msg(scene != NULL, "%s", error.text);
    return scene;
}

static void check_text(const imp_scene *scene, size_t stage, const char *expected)
{
    char *text = NULL;
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_msg(imp_piece_formula(scene, (imp_place){0, 0, 0}, stage, &text, &error) ==
                      IMP_SUCCESS,
                  "%s", error.text);
    ck_assert_str_eq(text, expected);
    free(text);
}

#define BALL                                                                                       \
    "radius = 0x1.3333333333333p-2; center0 = 1; center1 = 0; center2 = (-0.5); u in [0, 2*pi]; "  \
    "v in [-pi/2, pi/2]; center0 + radius*cos(v)*cos(u); center1 + radius*cos(v)*sin(u); "         \
    "center2 + radius*sin(v)"

START_TEST(numbers_are_bound_to_the_names_of_parameters)
{
    imp_scene *scene = scene_of("sphere radius=0.3 center=1,0,-0.5");
    ck_assert_uint_eq(imp_piece_stage_count(scene, (imp_place){0, 0, 0}), 1);
    check_text(scene, 0, BALL);
    imp_scene_free(scene);
}
END_TEST

START_TEST(isolated_types_print_what_they_print_here)
{
    imp_error error = {IMP_SUCCESS, ""};
    ck_assert_int_eq(imp_registry_isolate(registry, NULL, &error), IMP_SUCCESS);
    imp_scene *scene = scene_of("sphere radius=0.3 center=1,0,-0.5");
    check_text(scene, 0, BALL);
    imp_scene_free(scene);
}
END_TEST

/* A patch of 21 by 21 moving points, whose formula is longer than what a worker sends at once. */
static char *long_patch(void)
{
    char *text = malloc(65536);
    size_t used = (size_t)sprintf(text, "bezier degree=20,20 points=[");
    for (int list = 0; list < 2; ++list) {
        for (int k = 0; k < 441; ++k)
            used += (size_t)sprintf(text + used, "%s[%d.1,%d.2,0.3]", k > 0 ? "," : "", k, k % 21);
        used += (size_t)sprintf(text + used, list == 0 ? "] velocities=[" : "]");
    }
    return text;
}

START_TEST(callbacks_of_isolated_types_print_all_they_print_here)
{
    imp_error error = {IMP_SUCCESS, ""};
    char *stage = long_patch(), *here[2], *there[2];
    imp_scene *scene = scene_of(stage);
    ck_assert_int_eq(imp_piece_formula(scene, (imp_place){0, 0, 0}, 0, &here[0], &error),
                     IMP_SUCCESS);
    ck_assert_uint_gt(strlen(here[0]), 1 << 16);
    imp_scene *box = scene_of("box ! rotate rate=2");
    ck_assert_int_eq(imp_piece_formula(box, (imp_place){0, 0, 5}, 1, &here[1], &error),
                     IMP_SUCCESS);
    imp_scene_free(scene);
    imp_scene_free(box);
    ck_assert_int_eq(imp_registry_isolate(registry, NULL, &error), IMP_SUCCESS);
    scene = scene_of(stage);
    check_text(scene, 0, here[0]);
    box = scene_of("box ! rotate rate=2");
    ck_assert_int_eq(imp_piece_formula(box, (imp_place){0, 0, 5}, 1, &there[1], &error),
                     IMP_SUCCESS);
    ck_assert_str_eq(there[1], here[1]);
    ck_assert_int_eq(imp_piece_formula(box, (imp_place){0, 0, 5}, 0, &there[0], &error),
                     IMP_SUCCESS);
    ck_assert_ptr_nonnull(strstr(there[0], "corner2 = 0.5; "));
    imp_scene_free(scene);
    imp_scene_free(box);
    for (int k = 0; k < 2; ++k) {
        free(here[k]);
        free(there[k]);
    }
    free(stage);
}
END_TEST

/* What a type cannot say is no error. */
START_TEST(what_has_no_formula_is_null)
{
    imp_error error = {IMP_SUCCESS, ""};
    char *text = NULL;
    imp_scene *scene = scene_of("sphere ! bend curvature=[0,1]");
    ck_assert_int_eq(imp_piece_formula(scene, (imp_place){0, 0, 0}, 1, &text, &error), IMP_SUCCESS);
    ck_assert_ptr_null(text);
    imp_scene_free(scene);
}
END_TEST

/* A name that the text defines itself is not a parameter's. */
START_TEST(a_definition_hides_a_parameter)
{
    imp_scene *scene = scene_of("formula x=time0*u constants={\"time0\":3} time=0,1");
    check_text(scene, 0, "time0 = 3; u in [0, 1]; v in [0, 1]; t in [0, 1]; time0*u; v; 0");
    imp_scene_free(scene);
}
END_TEST

START_TEST(stages_are_the_type_and_its_maps)
{
    imp_stage stage, other;
    imp_error error;
    const imp_place at = {0, 0, 0};
    imp_scene *scene = scene_of("sphere ! rotate rate=1 ! translate velocity=1,0,0");
    ck_assert_uint_eq(imp_piece_stage_count(scene, at), 3);
    ck_assert_int_eq(imp_piece_stage(scene, at, 0, &stage, &error), IMP_SUCCESS);
    ck_assert_int_eq(stage.kind, IMP_TYPE_SURFACE);
    ck_assert_str_eq(stage.type, "sphere");
    ck_assert_int_eq(imp_piece_stage(scene, at, 2, &other, &error), IMP_SUCCESS);
    ck_assert_int_eq(other.kind, IMP_TYPE_MAP);
    ck_assert_str_eq(other.type, "translate");
    ck_assert_ptr_ne(stage.identity, other.identity);
    imp_scene_free(scene);
}
END_TEST

START_TEST(misuse_is_answered)
{
    imp_stage stage;
    imp_error error;
    char *text;
    const imp_place none = {0, 1, 0}, at = {0, 0, 0};
    imp_scene *scene = scene_of("sphere");
    ck_assert_uint_eq(imp_piece_stage_count(scene, none), 0);
    ck_assert_uint_eq(imp_piece_stage_count(NULL, at), 0);
    ck_assert_int_eq(imp_piece_stage(scene, at, 1, &stage, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_formula(scene, none, 0, &text, &error), IMP_ERROR_USAGE);
    ck_assert_int_eq(imp_piece_formula(scene, at, 0, NULL, &error), IMP_ERROR_USAGE);
    imp_scene_free(scene);
}
END_TEST

/* --- Numbers ---------------------------------------------------------------------------------- */

static void append(const imp_text_sink *sink, const char *text, size_t size)
{
    char *to = sink->host;
    const size_t used = strlen(to);
    ck_assert_uint_lt(used + size, 200);
    memcpy(to + used, text, size);
    to[used + size] = '\0';
}

/* A number as it stands in formulas. */
typedef struct written {
    char text[200];
} written;

static written written_number(double x)
{
    written w = {""};
    const imp_text_sink to = {.struct_size = sizeof to, .host = w.text, .add = append};
    imp_add_number(&to, x);
    return w;
}

START_TEST(short_numbers_are_decimal)
{
    ck_assert_str_eq(written_number(0).text, "0");
    ck_assert_str_eq(written_number(12).text, "12");
    ck_assert_str_eq(written_number(0.375).text, "0.375");
    ck_assert_str_eq(written_number(-2.015625).text, "(-2.015625)");
    ck_assert_str_eq(written_number(0.1).text, "0x1.999999999999ap-4");
    ck_assert_str_eq(written_number(0x1p60).text, "0x1p60");
    ck_assert_str_eq(written_number(0x1p-1074).text, "0x1p-1074");
}
END_TEST

/* Any bit pattern that is a number. */
START_TEST(numbers_read_back_exactly)
{
    uint64_t random = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        const uint64_t bits = random_bits(&random);
        double x = random_between(&random, -100, 100);
        if (k % 2 == 0) memcpy(&x, &bits, sizeof x);
        if (k % 8 == 1) x = rint(x * 64) / 64;
        if (!isfinite(x)) continue;
        char text[200];
        const written w = written_number(fabs(x));
        memcpy(text, w.text, sizeof text);
        ck_assert_msg(strtod(text, NULL) == fabs(x), "%a is written as %s", x, text);
    }
}
END_TEST

START_TEST(ranges_may_be_endless)
{
    char text[200] = "";
    const imp_text_sink to = {.struct_size = sizeof to, .host = text, .add = append};
    imp_add_range(&to, "t", -INFINITY, INFINITY);
    imp_add_range(&to, "u", -0.25, 0x1.fffffffffffffp1023);
    ck_assert_str_eq(text, "t in [-inf, inf]; u in [-0.25, 0x1.fffffffffffffp1023]; ");
}
END_TEST

int main(void)
{
    const TTest *const tests[] = {numbers_are_bound_to_the_names_of_parameters,
                                  isolated_types_print_what_they_print_here,
                                  callbacks_of_isolated_types_print_all_they_print_here,
                                  what_has_no_formula_is_null,
                                  a_definition_hides_a_parameter,
                                  stages_are_the_type_and_its_maps,
                                  misuse_is_answered,
                                  short_numbers_are_decimal,
                                  numbers_read_back_exactly,
                                  ranges_may_be_endless};
    return suite_main_with("formula_texts", tests, sizeof tests / sizeof tests[0], open_registry,
                           close_registry);
}
