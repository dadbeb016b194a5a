/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/reader/pipeline.h"
#include "core/reader/pipeline_value.h"
#include "tests/support/kit_registry.h"
#include "tests/support/suite.h"

static imp_registry *registry;
static imp_error error;

static json_t *read_line(const char *line)
{
    if (registry == NULL) registry = kit_registry();
    error = (imp_error){IMP_SUCCESS, ""};
    json_t *object = pipeline_read(registry, "a", line, &error);
    ck_assert((object == NULL) == (error.code != IMP_SUCCESS));
    return object;
}

/* The line becomes this JSON; single quotes stand for double ones. */
static void assert_becomes(const char *line, const char *quoted)
{
    json_t *object = read_line(line);
    ck_assert_msg(object != NULL, "%s: %s", line, error.text);
    char expected[500];
    size_t length = strlen(quoted);
    for (size_t i = 0; i <= length; ++i) expected[i] = quoted[i] == '\'' ? '"' : quoted[i];
    char *found = json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(15));
    ck_assert_str_eq(found, expected);
    free(found);
    json_decref(object);
}

static void assert_wrong(const char *line, const char *message)
{
    json_t *object = read_line(line);
    ck_assert_ptr_null(object);
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_str_eq(error.text, message);
}

/* Like assert_wrong, for what is found out only when the scene is built. */
static void assert_pair_wrong(const char *a, const char *b, const char *message)
{
    if (registry == NULL) registry = kit_registry();
    ck_assert_ptr_null(imp_scene_from_pair(registry, a, b, &error));
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_str_eq(error.text, message);
}

START_TEST(a_type_alone_is_a_pipeline)
{
    assert_becomes("kit", "{'type':'kit','maps':[]}");
    assert_becomes("  kit\t", "{'type':'kit','maps':[]}");
}
END_TEST

START_TEST(values_are_json_or_short_for_it)
{
    assert_becomes("kit center=[1,2,3]", "{'type':'kit','center':[1.0,2.0,3.0],'maps':[]}");
    assert_becomes("kit center=1,2,3", "{'type':'kit','center':[1.0,2.0,3.0],'maps':[]}");
    assert_becomes("kit points=[0,0,0],[1,0,0]",
                   "{'type':'kit','points':[[0.0,0.0,0.0],[1.0,0.0,0.0]],'maps':[]}");
    assert_becomes("kit points=[ [0, 0, 0],\n [1, 0, 0] ]",
                   "{'type':'kit','points':[[0.0,0.0,0.0],[1.0,0.0,0.0]],'maps':[]}");
    assert_becomes("kit closed=true", "{'type':'kit','closed':true,'maps':[]}");
    assert_becomes("kit constants={\"a\": 1}", "{'type':'kit','constants':{'a':1.0},'maps':[]}");
}
END_TEST

START_TEST(numbers_may_lack_a_zero_and_have_a_plus)
{
    assert_becomes("kit radius=.5", "{'type':'kit','radius':0.5,'maps':[]}");
    assert_becomes("kit radius=-.5e+1", "{'type':'kit','radius':-5.0,'maps':[]}");
    assert_becomes("kit radius=5.", "{'type':'kit','radius':5.0,'maps':[]}");
    assert_becomes("kit radius=+5", "{'type':'kit','radius':5.0,'maps':[]}");
    assert_becomes("kit center=.1,+.2,-3.e0", "{'type':'kit','center':[0.1,0.2,-3.0],'maps':[]}");
    assert_becomes("kit center=[.1,+.2,-3.]", "{'type':'kit','center':[0.1,0.2,-3.0],'maps':[]}");
    assert_becomes("kit constants={\".5\":.5}", "{'type':'kit','constants':{'.5':0.5},'maps':[]}");
}
END_TEST

START_TEST(strings_need_quotes_only_for_blanks_and_bars)
{
    assert_becomes("kit label=cos(2*pi*u)*(1+.1*sin(t))",
                   "{'type':'kit','label':'cos(2*pi*u)*(1+.1*sin(t))','maps':[]}");
    assert_becomes("kit label=atan2(v, u)", "{'type':'kit','label':'atan2(v, u)','maps':[]}");
    assert_becomes("kit label=5", "{'type':'kit','label':'5','maps':[]}");
    assert_becomes("kit label=a=b", "{'type':'kit','label':'a=b','maps':[]}");
    assert_becomes("kit label=\"a ! b\\n\"", "{'type':'kit','label':'a ! b\\n','maps':[]}");
    assert_becomes("kit label=\xC3\xA9", "{'type':'kit','label':'\xC3\xA9','maps':[]}");
}
END_TEST

/* No type of ours has a list of strings yet; the ABI allows them. */
START_TEST(lists_of_strings_need_no_brackets)
{
    const imp_parameter names = {.name = "names", .kind = IMP_KIND_STRING, .rank = 1};
    static const char *const texts[] = {"one,\"two, three\",4", "[\"one\", \"two, three\", \"4\"]"};
    for (int k = 0; k < 2; ++k) {
        json_t *list = NULL;
        char why[200] = "";
        ck_assert_int_eq(
            pipeline_value_read(&names, texts[k], strlen(texts[k]), &list, why, sizeof why),
            IMP_SUCCESS);
        char *found = json_dumps(list, JSON_COMPACT);
        ck_assert_str_eq(found, "[\"one\",\"two, three\",\"4\"]");
        free(found);
        json_decref(list);
    }
    json_t *none = NULL;
    char why[200] = "";
    ck_assert_int_eq(pipeline_value_read(&names, "one,\"\\q\"", 8, &none, why, sizeof why),
                     IMP_ERROR_SCENE);
    ck_assert_str_ne(why, "");
}
END_TEST

START_TEST(maps_stand_behind_bars_in_order)
{
    assert_becomes("kit radius=1 ! nudge by=1,0,0 ! nudge",
                   "{'type':'kit','radius':1.0,'maps':[{'type':'nudge','by':[1.0,0.0,0.0]},"
                   "{'type':'nudge'}]}");
    assert_becomes("kit radius=1!nudge by=1,0,0",
                   "{'type':'kit','radius':1.0,'maps':[{'type':'nudge','by':[1.0,0.0,0.0]}]}");
}
END_TEST

START_TEST(what_cannot_be_read_is_told_by_its_character)
{
    assert_wrong("", "a: at character 1: the line ends, expected a surface type's name");
    assert_wrong("  ", "a: at character 3: the line ends, expected a surface type's name");
    assert_wrong("! nudge", "a: at character 1: got '!', expected a surface type's name");
    assert_wrong("radius=1", "a: at character 1: got 'radius=1', expected a surface type's name");
    assert_wrong("kit !", "a: at character 6: the line ends, expected a map's name after '!'");
    assert_wrong("kit ! ! nudge", "a: at character 7: got '!', expected a map's name after '!'");
    assert_wrong("kit radius", "a: at character 5: got 'radius', expected name=value or '!'");
    assert_wrong("kit =1", "a: at character 5: got '=1', expected name=value or '!'");
    assert_wrong("kit radius=", "a: at character 5: 'radius' has no value");
    assert_wrong("kit radius= 1", "a: at character 5: 'radius' has no value");
    assert_wrong("kit radius=1 radius=2", "a: at character 14: 'radius' is given twice");
    assert_wrong("kit type=kit", "a: at character 5: 'type' is not a parameter");
    assert_wrong("kit center=[1,2", "a: at character 12: got '[' that is never closed");
    assert_wrong("kit center=1]", "a: at character 13: got ']' without its opening bracket");
    assert_wrong("kit label=\"x", "a: at character 11: got a quote that is never closed");
    assert_wrong("kit \xC3", "a: is not valid UTF-8");
    assert_wrong("kit label=\xC3\xA9 x", "a: at character 13: got 'x', expected name=value or '!'");
}
END_TEST

START_TEST(values_that_are_no_json_are_told_with_jansson_s_words)
{
    static const char *const lines[] = {
        "kit radius=1.2.3", "kit radius=1e999", "kit center=[1,2)",
        "kit center=1,,2",  "kit radius=.",     "kit radius=0x10",
        "kit radius=--1",   "kit center=[1,2}", "kit label=\"\\q\""};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        ck_assert_msg(read_line(lines[i]) == NULL, "%s", lines[i]);
        size_t value = (size_t)(strchr(lines[i], '=') - lines[i]) + 2;
        char place[60];
        snprintf(place, sizeof place, "a: at character %zu: ", value);
        ck_assert_msg(strncmp(error.text, place, strlen(place)) == 0, "%s", error.text);
        ck_assert_msg(strstr(error.text, "which is not a JSON value") != NULL, "%s", error.text);
    }
}
END_TEST

START_TEST(values_that_are_expressions_are_told_to_be_no_numbers)
{
    static const char *const lines[] = {"kit radius=2*3.14", "kit radius=1/3",
                                        "kit center=[1,2^3,0]", "kit center=1,sqrt(2),0"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; ++i) {
        ck_assert_msg(read_line(lines[i]) == NULL, "%s", lines[i]);
        ck_assert_msg(strstr(error.text, "only numbers are read here, no expressions") != NULL,
                      "%s", error.text);
    }
    ck_assert_ptr_null(read_line("kit label=\"a*b\\q\""));
    ck_assert_msg(strstr(error.text, "which is not a JSON value") != NULL, "%s", error.text);
}
END_TEST

START_TEST(what_does_not_fit_is_told_by_its_name)
{
    assert_pair_wrong("kit radius=-1", "kit radius=1", "a: radius: got -1, must be > 0");
    assert_pair_wrong("kit radius=1", "kit radius=big",
                      "b: radius: got \"big\", must be a number > 0");
    assert_pair_wrong("kit radius=nan", "kit radius=1",
                      "a: radius: got \"nan\", must be a number > 0");
    assert_pair_wrong("kit radius=-inf", "kit radius=1",
                      "a: radius: got \"-inf\", must be a number > 0");
    assert_pair_wrong("kit radius=1 points=0,0,0", "kit",
                      "a: points/0: got 0, must be an array of 3 numbers");
    assert_pair_wrong("kit radius=1 ! nudge by=1", "kit",
                      "a: nudge: by: got 1, must be an array of 3 numbers");
    assert_pair_wrong("kit", "kit", "a: 'radius' is missing; it must be a number > 0");
    assert_pair_wrong(
        "kti radius=1", "kit",
        "a: unknown surface type 'kti', did you mean 'kit'? `impinge list` shows what "
        "there is");
    assert_pair_wrong("kit radius=1 ! nugde", "kit",
                      "a: nugde: unknown map 'nugde', did you mean 'nudge'? `impinge list` shows "
                      "what there is");
    assert_pair_wrong("nudge", "kit",
                      "a: got the map 'nudge', must be a surface type; `impinge list` shows "
                      "what there is");
    assert_pair_wrong("kit radius=1 lable=x/y", "kit",
                      "a: lable: unknown parameter, did you mean 'label'? kit takes "
                      "radius, center, points, count, closed, label, constants, weights, mood");
    assert_pair_wrong("kit radius=1 mood=radius", "kit", "a: radius: got 1, must be 2");
}
END_TEST

START_TEST(a_pair_is_a_scene_of_bodies_a_and_b)
{
    registry = kit_registry();
    imp_scene *scene =
        imp_scene_from_pair(registry, "kit radius=1 center=1,2,3 ! nudge by=0,0,1 ! nudge by=0,1,0",
                            "kit radius=.5", &error);
    ck_assert_ptr_nonnull(scene);
    ck_assert_uint_eq(imp_scene_body_count(scene), 2);
    ck_assert_str_eq(imp_scene_body_name(scene, 0), "a");
    ck_assert_str_eq(imp_scene_body_name(scene, 1), "b");
    double p[3] = {0, 0, 0}, x[3];
    ck_assert_int_eq(imp_scene_eval(scene, 0, 0, 1, p, x, NULL, &error), IMP_SUCCESS);
    ck_assert_double_eq(x[0], 1);
    ck_assert_double_eq(x[1], 3);
    ck_assert_double_eq(x[2], 4);
    imp_scene_free(scene);
}
END_TEST

START_TEST(a_pair_has_the_text_of_a_scene_file)
{
    registry = kit_registry();
    char *text = imp_pair_to_json(registry, "kit radius=1 ! nudge by=0,0,.1 ! nudge by=0,1,0",
                                  "kit radius=5e-1 label=x", &error);
    ck_assert_ptr_nonnull(text);
    ck_assert_str_eq(
        text,
        "{\"bodies\":[{\"name\":\"a\",\"surfaces\":[{\"type\":\"kit\",\"radius\":1.0,\"maps\":["
        "{\"type\":\"nudge\",\"by\":[0.0,0.0,0.10000000000000001]},"
        "{\"type\":\"nudge\",\"by\":[0.0,1.0,0.0]}]}]},"
        "{\"name\":\"b\",\"surfaces\":[{\"type\":\"kit\",\"radius\":0.5,\"label\":\"x\","
        "\"maps\":[]}]}]}");
    imp_scene *scene = imp_scene_from_json(registry, text, strlen(text), "pair", &error);
    free(text);
    ck_assert_ptr_nonnull(scene);
    ck_assert_str_eq(imp_scene_body_name(scene, 1), "b");
    imp_scene_free(scene);
    ck_assert_ptr_null(imp_pair_to_json(registry, "kit radius=1", "kit radius=[", &error));
    ck_assert_ptr_nonnull(strstr(error.text, "b: at character 12: got '[' that is never closed"));
    ck_assert_ptr_null(imp_pair_to_json(registry, "! nudge", "kit", &error));
    ck_assert_ptr_nonnull(strstr(error.text, "a: at character 1: got '!'"));
    imp_registry_free(registry);
    registry = NULL;
}
END_TEST

START_TEST(random_lines_are_read_or_refused_and_never_harm)
{
    static const char *const pieces[] = {
        "kit", "radius", "=",      "1", " ",    "!",        "nudge", "by",    ",",        "[",
        "]",   "\"",     "{",      "}", "(",    ")",        "\\",    "label", ".",        "-",
        "+",   "e",      "points", ":", "true", "\xC3\xA9", "\xC3",  "\t",    "constants"};
    uint64_t state = suite_seed();
    registry = kit_registry();
    for (int k = 0; k < suite_times(40000); ++k) {
        char line[200] = "";
        if (random_bits(&state) % 2) strcat(line, "kit radius=1 label=");
        for (uint64_t n = random_bits(&state) % 12; n > 0; --n)
            strcat(line, pieces[random_bits(&state) % (sizeof pieces / sizeof *pieces)]);
        imp_scene *scene = imp_scene_from_pair(registry, line, line, &error);
        imp_scene_free(scene);
    }
    imp_registry_free(registry);
    registry = NULL;
}
END_TEST

SUITE_MAIN("pipeline", a_type_alone_is_a_pipeline, values_are_json_or_short_for_it,
           numbers_may_lack_a_zero_and_have_a_plus, strings_need_quotes_only_for_blanks_and_bars,
           lists_of_strings_need_no_brackets, maps_stand_behind_bars_in_order,
           what_cannot_be_read_is_told_by_its_character,
           values_that_are_no_json_are_told_with_jansson_s_words,
           values_that_are_expressions_are_told_to_be_no_numbers,
           what_does_not_fit_is_told_by_its_name, a_pair_is_a_scene_of_bodies_a_and_b,
           a_pair_has_the_text_of_a_scene_file, random_lines_are_read_or_refused_and_never_harm)
