/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plugins/mesh/mesh_text.h"
#include "tests/support/suite.h"

/* Numbers of text files of meshes are those that strtod reads, to the last bit. */

static void check_number(const char *word)
{
    char *end;
    double x, y = strtod(word, &end);
    ck_assert_msg(mesh_text_number(word, &x), "%s", word);
    ck_assert(*end == '\0');
    ck_assert_msg(memcmp(&x, &y, sizeof x) == 0, "%s: got %.17g, strtod %.17g", word, x, y);
}

START_TEST(numbers_are_those_of_strtod)
{
    static const char *const words[] = {
        "0",   "-0",  "+0.0", ".5",  "5.",   "-.25", "000000000000001",  "999999999999999",
        "0.1", "1e3", "1.e2", "1E9", "0.00", "-1.5", "9007199254740993", ".000000000000001"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) check_number(words[k]);
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(20000); ++k) {
        char word[64];
        const double x = random_between(&state, -1, 1) * random_power(&state, -20, 40);
        snprintf(word, sizeof word, "%.*f", (int)(random_bits(&state) % 18), x);
        check_number(word);
        snprintf(word, sizeof word, "%.*g", (int)(random_bits(&state) % 18), x);
        check_number(word);
    }
}
END_TEST

START_TEST(what_is_no_number_is_none)
{
    static const char *const words[] = {"",   "-",   "+",   ".",   "-.",    "1.2.3", "1-2", "--1",
                                        "1e", "0x1", "nan", "inf", "1e999", "1,5",   "e5"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        double x;
        ck_assert_msg(!mesh_text_number(words[k], &x), "%s", words[k]);
    }
}
END_TEST

START_TEST(integers_have_fifteen_digits_at_most)
{
    static const char *const none[] = {"", "-", "+", "1.0", "1 ", "1000000000000000", "1e3", "--1"};
    int64_t k;
    for (size_t i = 0; i < sizeof none / sizeof *none; ++i)
        ck_assert_msg(!mesh_text_integer(none[i], &k), "%s", none[i]);
    ck_assert(mesh_text_integer("999999999999999", &k) && k == 999999999999999);
    ck_assert(mesh_text_integer("-007", &k) && k == -7);
    ck_assert(mesh_text_integer("+12", &k) && k == 12);
}
END_TEST

/* Words of all lines of a text, one behind the other, each line's number before its words. */
static void check_words(const char *bytes, size_t length, bool continues, const char *expected)
{
    mesh_text text = {.at = bytes, .end = bytes + length};
    char found[400] = "";
    while (mesh_text_line(&text, continues)) {
        const char *word;
        snprintf(found + strlen(found), sizeof found - strlen(found), "%zu:", text.line);
        while ((word = mesh_text_word(&text)) != NULL)
            snprintf(found + strlen(found), sizeof found - strlen(found), "%s ", word);
    }
    ck_assert(mesh_text_status(&text) == IMP_STATUS_OK);
    ck_assert_str_eq(found, expected);
    mesh_text_clear(&text);
}

#define CHECK_WORDS(BYTES, CONTINUES, EXPECTED)                                                    \
    check_words(BYTES, sizeof BYTES - 1, CONTINUES, EXPECTED)

START_TEST(lines_are_cut_into_words)
{
    CHECK_WORDS("", false, "");
    CHECK_WORDS("\n\r\n a\tb \r c#d\n#e\n\v\f\nf", false, "3:a b 4:c 7:f ");
    CHECK_WORDS("a \\\nb\\#c\nd\ne\\", false, "1:a \\ 2:b\\ 3:d 4:e\\ ");
    CHECK_WORDS("a \\\nb\\#c\nd\ne\\", true, "3:a b d 4:e ");
    CHECK_WORDS("a\0b \0\n", false, "1:a\1b \1 ");
    char longest[301];
    memset(longest, 'x', 300);
    memcpy(longest + 297, "#y\n", 3);
    char expected[301] = "1:";
    memset(expected + 2, 'x', 297);
    strcpy(expected + 299, " ");
    check_words(longest, 300, false, expected);
}
END_TEST

SUITE_MAIN("mesh_text", numbers_are_those_of_strtod, what_is_no_number_is_none,
           integers_have_fifteen_digits_at_most, lines_are_cut_into_words)
