/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/common/spelling.h"
#include "core/plugin/parameters.h"
#include "tests/support/suite.h"

#include <string.h>

/* A row with the usual rest: no limits, required. */
#define ROW(NAME, KIND, ...)                                                                       \
    {                                                                                              \
        .name = NAME, .unit = "1", .doc = "", .kind = KIND, .min = -INFINITY, .max = INFINITY,     \
        __VA_ARGS__                                                                                \
    }
#define POSITIVE                                                                                   \
    {                                                                                              \
        .name = "radius", .unit = "length", .doc = "", .kind = IMP_KIND_NUMBER,                    \
        .flags = IMP_PARAMETER_MIN_OPEN, .min = 0, .max = INFINITY                                 \
    }

static const imp_parameter positive[] = {POSITIVE};
static const imp_parameter vector[] = {ROW("axis", IMP_KIND_NUMBER, .rank = 1, .extent = {3})};
static const imp_parameter points[] = {ROW("points", IMP_KIND_NUMBER, .rank = 2, .extent = {0, 3})};
static const imp_parameter cube[] = {ROW("cube", IMP_KIND_NUMBER, .rank = 3, .extent = {0, 0, 0})};
static const imp_parameter integer[] = {ROW("count", IMP_KIND_INTEGER, .rank = 0)};
static const imp_parameter boolean[] = {ROW("closed", IMP_KIND_BOOLEAN, .rank = 0)};
static const imp_parameter string[] = {ROW("x", IMP_KIND_STRING, .rank = 0)};
static const imp_parameter table_row[] = {ROW("constants", IMP_KIND_TABLE, .rank = 0)};
static const imp_parameter scalar[] = {ROW(
    "coefficients", IMP_KIND_NUMBER, .flags = IMP_PARAMETER_SCALAR_OK, .rank = 1, .extent = {0})};
static const imp_parameter preset[] = {
    ROW("center", IMP_KIND_NUMBER, .default_value = "[1, 2, 3]", .rank = 1, .extent = {3})};
static const imp_parameter optional[] = {
    ROW("weights", IMP_KIND_NUMBER, .flags = IMP_PARAMETER_OPTIONAL, .rank = 1, .extent = {0})};
static const imp_parameter between[] = {{.name = "e",
                                         .unit = "1",
                                         .doc = "",
                                         .kind = IMP_KIND_NUMBER,
                                         .flags = IMP_PARAMETER_MIN_OPEN,
                                         .min = 0,
                                         .max = 2}};

static imp_error error;

/* Reads {text} by a table of one row. */
static imp_code read_one(const imp_parameter *row, const char *text, parameter_values *values,
                         json_t **object)
{
    json_error_t fault;
    *object = json_loads(text, PARAMETERS_JSON_FLAGS, &fault);
    ck_assert_msg(*object != NULL, "%s: %s", text, fault.text);
    parameter_table table = {row, 1, sizeof *row};
    place at = place_document("s");
    error = (imp_error){IMP_SUCCESS, ""};
    return parameters_read(&table, "thing", *object, "/scenes/", NULL, &at, values, &error);
}

static void assert_refused(const imp_parameter *row, const char *text, const char *message)
{
    parameter_values values;
    json_t *object;
    ck_assert_int_eq(read_one(row, text, &values, &object), IMP_ERROR_SCENE);
    ck_assert_int_eq(error.code, IMP_ERROR_SCENE);
    ck_assert_str_eq(error.text, message);
    json_decref(object);
}

/* Numbers of the value, and its first extent. */
static void assert_numbers(const imp_parameter *row, const char *text, size_t extent, size_t count,
                           const double *numbers)
{
    parameter_values values;
    json_t *object;
    imp_code code = read_one(row, text, &values, &object);
    ck_assert_msg(code == IMP_SUCCESS, "%s: %s", text, error.text);
    ck_assert_uint_eq(values.value[0].count, count);
    ck_assert_uint_eq(values.value[0].extent[0], extent);
    for (size_t i = 0; i < count; ++i) ck_assert_double_eq(values.value[0].number[i], numbers[i]);
    parameters_clear(&values);
    json_decref(object);
}

START_TEST(numbers_are_taken_as_written)
{
    assert_numbers(positive, "{\"radius\": 2.5}", 1, 1, (double[]){2.5});
    assert_numbers(positive, "{\"radius\": 100000000000000000000000}", 1, 1, (double[]){1e23});
    assert_numbers(positive, "{\"radius\": 5e-324}", 1, 1, (double[]){5e-324});
    assert_numbers(vector, "{\"axis\": [0, -1, 2]}", 3, 3, (double[]){0, -1, 2});
    assert_numbers(points, "{\"points\": [[1,2,3],[4,5,6]]}", 2, 6, (double[]){1, 2, 3, 4, 5, 6});
    assert_numbers(cube, "{\"cube\": [[[1],[2]]]}", 1, 2, (double[]){1, 2});
}
END_TEST

START_TEST(whole_numbers_may_be_written_as_reals_but_not_have_a_fraction)
{
    assert_numbers(integer, "{\"count\": 3}", 1, 1, (double[]){3});
    assert_numbers(integer, "{\"count\": -3.0}", 1, 1, (double[]){-3});
    assert_numbers(integer, "{\"count\": 9007199254740992}", 1, 1, (double[]){0x1p53});
    assert_refused(integer, "{\"count\": 3.5}", "s: /count: got 3.5, must be a whole number");
    assert_refused(integer, "{\"count\": 1e16}", "s: /count: got 1e+16, must be a whole number");
    assert_refused(integer, "{\"count\": \"3\"}", "s: /count: got \"3\", must be a whole number");
}
END_TEST

START_TEST(booleans_are_true_or_false_only)
{
    assert_numbers(boolean, "{\"closed\": true}", 1, 1, (double[]){1});
    assert_numbers(boolean, "{\"closed\": false}", 1, 1, (double[]){0});
    assert_refused(boolean, "{\"closed\": 1}", "s: /closed: got 1, must be true or false");
}
END_TEST

START_TEST(strings_and_tables_keep_their_texts_and_order)
{
    parameter_values values;
    json_t *object;
    ck_assert_int_eq(read_one(string, "{\"x\": \"cos(u)\"}", &values, &object), IMP_SUCCESS);
    ck_assert_str_eq(values.value[0].string[0], "cos(u)");
    ck_assert_ptr_null(values.value[0].number);
    parameters_clear(&values);
    json_decref(object);
    ck_assert_int_eq(read_one(table_row, "{\"constants\": {\"z\": 1, \"a\": 2}}", &values, &object),
                     IMP_SUCCESS);
    ck_assert_uint_eq(values.value[0].count, 2);
    ck_assert_str_eq(values.value[0].string[0], "z");
    ck_assert_double_eq(values.value[0].number[1], 2);
    parameters_clear(&values);
    json_decref(object);
    assert_refused(string, "{\"x\": 1}", "s: /x: got 1, must be a string");
    assert_refused(table_row, "{\"constants\": {\"a\": \"b\"}}",
                   "s: /constants/a: got \"b\", must be a number");
    assert_refused(table_row, "{\"constants\": [1]}",
                   "s: /constants: got an array of 1, must be an object of numbers");
}
END_TEST

START_TEST(ranges_are_kept_and_told_with_their_ends)
{
    assert_refused(positive, "{\"radius\": -1}", "s: /radius: got -1, must be > 0");
    assert_refused(positive, "{\"radius\": 0}", "s: /radius: got 0, must be > 0");
    assert_refused(positive, "{\"radius\": -0.0}", "s: /radius: got -0, must be > 0");
    assert_refused(between, "{\"e\": 2.0000000000000004}",
                   "s: /e: got 2.0000000000000004, must be in (0, 2]");
    assert_numbers(between, "{\"e\": 2}", 1, 1, (double[]){2});
    imp_parameter below = *between;
    below.min = -INFINITY;
    assert_refused(&below, "{\"e\": 3}", "s: /e: got 3, must be <= 2");
    below.flags = IMP_PARAMETER_MAX_OPEN;
    assert_refused(&below, "{\"e\": 2}", "s: /e: got 2, must be < 2");
}
END_TEST

START_TEST(kinds_are_told_by_what_was_found)
{
    assert_refused(positive, "{\"radius\": \"big\"}",
                   "s: /radius: got \"big\", must be a number > 0");
    assert_refused(positive, "{\"radius\": null}", "s: /radius: got null, must be a number > 0");
    assert_refused(positive, "{\"radius\": [1]}",
                   "s: /radius: got an array of 1, must be a number > 0");
    assert_refused(vector, "{\"axis\": 1}", "s: /axis: got 1, must be an array of 3 numbers");
    assert_refused(vector, "{\"axis\": {}}",
                   "s: /axis: got an object, must be an array of 3 numbers");
}
END_TEST

START_TEST(shapes_must_fit_and_not_be_ragged)
{
    assert_refused(vector, "{\"axis\": [1, 2]}",
                   "s: /axis: got an array of 2, must be an array of 3 numbers");
    assert_refused(vector, "{\"axis\": [1, [2], 3]}",
                   "s: /axis/1: got an array of 1, must be a number");
    assert_refused(points, "{\"points\": []}",
                   "s: /points: got an array of 0, must be 1 element or more");
    assert_refused(points, "{\"points\": [[1,2,3],[4,5]]}",
                   "s: /points/1: got an array of 2, must be an array of 3 numbers");
    assert_refused(points, "{\"points\": [1,2,3]}",
                   "s: /points/0: got 1, must be an array of 3 numbers");
    assert_refused(cube, "{\"cube\": [[[1],[2]],[[1]]]}",
                   "s: /cube/1: got an array of 1, must be 2 as in the first one");
    assert_refused(cube, "{\"cube\": [[[1],[2]],[[1],[2,3]]]}",
                   "s: /cube/1/1: got an array of 2, must be 1 as in the first one");
}
END_TEST

START_TEST(a_bare_value_stands_for_an_array_of_one_where_that_is_allowed)
{
    assert_numbers(scalar, "{\"coefficients\": 7}", 1, 1, (double[]){7});
    assert_numbers(scalar, "{\"coefficients\": [7, 8]}", 2, 2, (double[]){7, 8});
    assert_refused(scalar, "{\"coefficients\": \"7\"}",
                   "s: /coefficients: got \"7\", must be a number");
}
END_TEST

START_TEST(presets_stand_in_and_optional_ones_are_absent)
{
    assert_numbers(preset, "{}", 3, 3, (double[]){1, 2, 3});
    assert_numbers(preset, "{\"center\": [4, 5, 6]}", 3, 3, (double[]){4, 5, 6});
    assert_numbers(optional, "{}", 0, 0, NULL);
    assert_refused(positive, "{}", "s: 'radius' is missing; it must be a number > 0");
}
END_TEST

START_TEST(unknown_names_are_refused_with_the_nearest)
{
    assert_refused(positive, "{\"radius\": 1, \"raduis\": 2}",
                   "s: /raduis: unknown parameter, did you mean 'radius'? thing takes "
                   "radius");
    assert_refused(positive, "{\"radius\": 1, \"a/b~c\\n\": 2}",
                   "s: /a~1b~0c?: unknown parameter; thing takes radius");
    assert_numbers(positive, "{\"radius\": 1, \"type\": \"thing\", \"maps\": []}", 1, 1,
                   (double[]){1});
}
END_TEST

START_TEST(rows_longer_than_ours_are_stepped_over)
{
    struct {
        imp_parameter row;
        double more;
    } rows[2] = {{POSITIVE, 1}, {ROW("x", IMP_KIND_NUMBER, .rank = 0), 1}};
    parameter_table table = {&rows[0].row, 2, sizeof rows[0]};
    ck_assert_int_eq(parameter_table_find(&table, "x"), 1);
    ck_assert_int_eq(parameter_table_find(&table, "y"), -1);
    ck_assert_str_eq(parameter_table_nearest(&table, "radios"), "radius");
}
END_TEST

/* What a complaint about {"points": [[1,2,3],[4,5,6]]} becomes. */
static void assert_complaint(imp_create_error why, const char *message)
{
    parameter_values values;
    json_t *object;
    ck_assert_int_eq(read_one(points, "{\"points\": [[1,2,3],[4,5,6]]}", &values, &object),
                     IMP_SUCCESS);
    parameter_table table = {points, 1, sizeof *points};
    place at = place_document("s");
    ck_assert_int_eq(parameters_create_error(&table, &values, &why, &at, &error), IMP_ERROR_SCENE);
    ck_assert_str_eq(error.text, message);
    parameters_clear(&values);
    json_decref(object);
}

START_TEST(complaints_of_a_type_get_their_place)
{
    assert_complaint((imp_create_error){.parameter = 0, .element = 1, .text = "got a knot"},
                     "s: /points/1: got a knot");
    assert_complaint((imp_create_error){.parameter = 0, .element = -1, .text = "got a knot"},
                     "s: /points: got a knot");
    assert_complaint((imp_create_error){.parameter = 0, .element = 2, .text = "got a knot"},
                     "s: /points: got a knot");
    assert_complaint((imp_create_error){.parameter = -1, .element = -1, .text = "got a knot"},
                     "s: got a knot");
    assert_complaint((imp_create_error){.parameter = 1, .element = 1, .text = "got a knot"},
                     "s: got a knot");
    assert_complaint(
        (imp_create_error){.parameter = INT32_MIN, .element = INT64_MIN, .text = "\x1B[31m\xFF"},
        "s: ?[31m?");
    assert_complaint((imp_create_error){.parameter = 0, .element = -1, .text = ""},
                     "s: /points: refused, and the plugin does not say why");
    imp_create_error endless = {.parameter = -1, .element = -1};
    memset(endless.text, 'x', sizeof endless.text);
    char expected[260] = "s: ";
    memset(expected + 3, 'x', sizeof endless.text - 1);
    assert_complaint(endless, expected);
}
END_TEST

START_TEST(a_place_too_long_to_print_is_cut)
{
    static char name[5000];
    memset(name, 'n', sizeof name - 1);
    place root = place_document(name), at = place_key(&root, name);
    place_error(&at, &error, IMP_ERROR_SCENE, "got nothing");
    ck_assert_uint_lt(strlen(error.text), sizeof error.text);
    ck_assert_ptr_nonnull(strstr(error.text, "got nothing"));
    ck_assert_int_eq(place_error(&at, NULL, IMP_ERROR_SCENE, "x"), IMP_ERROR_SCENE);
}
END_TEST

START_TEST(distances_count_changes_and_swaps)
{
    ck_assert_uint_eq(spelling_distance("", ""), 0);
    ck_assert_uint_eq(spelling_distance("abc", "abc"), 0);
    ck_assert_uint_eq(spelling_distance("abc", ""), 3);
    ck_assert_uint_eq(spelling_distance("abc", "acb"), 1);
    ck_assert_uint_eq(spelling_distance("kitten", "sitting"), 3);
    static char huge[200];
    memset(huge, 'h', sizeof huge - 1);
    ck_assert_uint_eq(spelling_distance(huge, "h"), SIZE_MAX);
}
END_TEST

START_TEST(lines_are_utf8_without_control_characters)
{
    ck_assert(text_is_line("a \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x99\x82"));
    ck_assert(text_is_line(""));
    ck_assert(!text_is_line(NULL));
    const char *const broken[] = {
        "\n",       "\x7F",         "\xC2\x85",         "\x80",
        "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",     "\xF4\x90\x80\x80",
        "\xC3",     "\xE2\x82",     "\xF0\x82\x82\xAC", "\xFF"};
    for (size_t i = 0; i < sizeof broken / sizeof *broken; ++i) {
        char copy[8];
        strcpy(copy, broken[i]);
        ck_assert_msg(!text_is_line(copy), "text %zu", i);
        text_clean(copy);
        ck_assert_msg(text_is_line(copy), "text %zu", i);
        ck_assert_uint_eq(strlen(copy), strlen(broken[i]));
    }
}
END_TEST

START_TEST(short_numbers_are_written_as_by_printf)
{
    uint64_t state = suite_seed();
    int written = 0;
    const int times = suite_times(300000);
    for (int k = 0; k < times; ++k) {
        char found[TEXT_SHORT + 1], expected[40], word[40];
        double x = random_between(&state, -1, 1) * random_power(&state, -16, 52);
        snprintf(word, sizeof word, "%.*g", (int)(random_bits(&state) % 18), x);
        x = strtod(word, NULL);
        snprintf(expected, sizeof expected, "%.15g", x);
        if (text_short_number(found, x)) {
            ck_assert_msg(strcmp(found, expected) == 0 && strtod(found, NULL) == x, "%s: %s",
                          expected, found);
            ++written;
        } else {
            ck_assert_msg(strchr(expected, 'e') != NULL || strtod(expected, NULL) != x ||
                              fabs(x) < 1e-4,
                          "%s is not written", expected);
        }
    }
    ck_assert_msg(2 * written > times, "only %d of %d", written, times);
    char found[TEXT_SHORT + 1];
    ck_assert(text_short_number(found, 0) && strcmp(found, "0") == 0);
    ck_assert(!text_short_number(found, -0.0) && !text_short_number(found, NAN));
    ck_assert(!text_short_number(found, INFINITY) && !text_short_number(found, 1e15));
    ck_assert(text_short_number(found, -999999999999999) && strcmp(found, "-999999999999999") == 0);
    ck_assert(text_short_number(found, 1e-4) && strcmp(found, "0.0001") == 0);
    ck_assert(text_short_number(found, -0.000123456789012345) && strlen(found) < sizeof found);
}
END_TEST

static void check_fifteen_digits(double x)
{
    char found[TEXT_SHORT + 1], expected[40];
    snprintf(expected, sizeof expected, "%.15g", x);
    const bool is_large = x == 0 || fabs(x) >= 1e-4;
    const bool is_plain = is_large && strchr(expected, 'e') == NULL && strcmp(expected, "-0") != 0;
    ck_assert_msg(text_fifteen_digits(found, x) == is_plain, "%a, %s", x, expected);
    ck_assert_msg(!is_plain || strcmp(found, expected) == 0, "%a: %s, not %s", x, found, expected);
}

/* Quarters and their kin have ties, which go to the even digit. */
START_TEST(fifteen_digits_are_those_of_printf)
{
    uint64_t state = suite_seed();
    const int times = suite_times(100000);
    for (int k = 0; k < times; ++k) {
        const double x = random_between(&state, -1, 1) * random_power(&state, -16, 52);
        const double part = (double)(1 << random_bits(&state) % 12);
        check_fifteen_digits(x);
        check_fifteen_digits(rint(x * part) / part);
    }
    for (double power = 1e-5; power < 1e17; power *= 10) {
        double below = power, above = power;
        for (int k = 0; k < 10; ++k) {
            check_fifteen_digits(below), check_fifteen_digits(-above);
            below = nextafter(below, 0), above = nextafter(above, INFINITY);
        }
    }
    check_fifteen_digits(0), check_fifteen_digits(999999999999999.5);
    check_fifteen_digits(100000000000000.5), check_fifteen_digits(100000000000001.5);
    char found[TEXT_SHORT + 1];
    ck_assert(!text_fifteen_digits(found, -0.0) && !text_fifteen_digits(found, NAN));
    ck_assert(!text_fifteen_digits(found, INFINITY));
}
END_TEST

START_TEST(numbers_in_words_read_back_as_themselves)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        double x = random_power(&state, -1070, 1020) * (random_bits(&state) % 2 ? 1 : -1);
        ck_assert_double_eq(strtod(text_of_number(x).at, NULL), x);
    }
    ck_assert_str_eq(text_of_number(0.1).at, "0.1");
    ck_assert_str_eq(text_of_number(-1).at, "-1");
}
END_TEST

START_TEST(errors_are_cut_between_characters)
{
    char word[3] = "\xC3\xA9";
    for (size_t shift = 0; shift < 2; ++shift) {
        char text[2000] = "";
        for (size_t i = 0; i < shift; ++i) strcat(text, "x");
        while (strlen(text) + 3 < sizeof text) strcat(text, word);
        error_set(&error, IMP_ERROR_SCENE, "%s", text);
        ck_assert(text_is_utf8(error.text));
        ck_assert_uint_ge(strlen(error.text), sizeof error.text - 2);
    }
    ck_assert_int_eq(error_set(NULL, IMP_ERROR_FILE, "x"), IMP_ERROR_FILE);
}
END_TEST

START_TEST(every_code_has_its_phrase)
{
    for (int code = IMP_SUCCESS; code <= IMP_ERROR_LIMIT; ++code) {
        ck_assert_str_ne(imp_code_text((imp_code)code), "");
        ck_assert_str_ne(imp_code_text((imp_code)code), imp_code_text((imp_code)99));
    }
    ck_assert_str_eq(imp_version(), "libimpinge " PACKAGE_VERSION);
}
END_TEST

START_TEST(relative_names_of_files_begin_at_the_scenes_folder)
{
    static const imp_parameter row = {.name = "n",
                                      .kind = IMP_KIND_STRING,
                                      .flags = IMP_PARAMETER_FILE,
                                      .default_value = "\"preset.csv\""};
    static const struct {
        const char *text, *name;
    } cases[] = {{"{\"n\":\"a.csv\"}", "/scenes/a.csv"},
                 {"{\"n\":\"../b/a.csv\"}", "/scenes/../b/a.csv"},
                 {"{\"n\":\"/x/a.csv\"}", "/x/a.csv"},
                 {"{\"n\":\"\"}", ""},
                 {"{}", "preset.csv"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        parameter_values values;
        json_t *object;
        ck_assert_int_eq(read_one(&row, cases[k].text, &values, &object), IMP_SUCCESS);
        ck_assert_str_eq(values.value[0].string[0], cases[k].name);
        parameters_clear(&values);
        json_decref(object);
    }
}
END_TEST

SUITE_MAIN("parameters", every_code_has_its_phrase, numbers_are_taken_as_written,
           whole_numbers_may_be_written_as_reals_but_not_have_a_fraction,
           booleans_are_true_or_false_only, strings_and_tables_keep_their_texts_and_order,
           ranges_are_kept_and_told_with_their_ends, kinds_are_told_by_what_was_found,
           shapes_must_fit_and_not_be_ragged,
           a_bare_value_stands_for_an_array_of_one_where_that_is_allowed,
           relative_names_of_files_begin_at_the_scenes_folder,
           presets_stand_in_and_optional_ones_are_absent,
           unknown_names_are_refused_with_the_nearest, rows_longer_than_ours_are_stepped_over,
           complaints_of_a_type_get_their_place, a_place_too_long_to_print_is_cut,
           distances_count_changes_and_swaps, lines_are_utf8_without_control_characters,
           short_numbers_are_written_as_by_printf, fifteen_digits_are_those_of_printf,
           numbers_in_words_read_back_as_themselves, errors_are_cut_between_characters)
