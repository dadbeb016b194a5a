/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/plugin/parameters.h"
#include "core/reader/json_quick.h"
#include "tests/support/same_json.h"
#include "tests/support/suite.h"

/* What the quick reader makes of a text is what jansson makes of it; what jansson refuses it leaves
 * to jansson. */

static reading_budget budget;

/* Returns whether it was read quickly. */
static bool check_text(const char *text, size_t length)
{
    json_error_t fault;
    json_quick_end end;
    const uint64_t before = budget.bytes;
    json_t *expected = json_loadb(text, length, PARAMETERS_JSON_FLAGS, &fault);
    json_t *found = json_quick_parse(text, length, &budget, &end);
    ck_assert_msg((found != NULL) == (end == JSON_QUICK_DONE), "%.*s", (int)length, text);
    ck_assert(end == JSON_QUICK_DONE || end == JSON_QUICK_LEFT);
    ck_assert(end == JSON_QUICK_DONE || budget.bytes == before);
    ck_assert_msg(found == NULL || (expected != NULL && same_json(found, expected)), "%.*s",
                  (int)length, text);
    json_decref(found);
    json_decref(expected);
    return end == JSON_QUICK_DONE;
}

/* --- Random texts ----------------------------------------------------------------------------- */

typedef struct random_text {
    char at[1 << 14];
    size_t length;
    uint64_t state;
} random_text;

static uint64_t draw(random_text *t, uint64_t count) { return random_bits(&t->state) % count; }

static void put(random_text *t, const char *piece)
{
    const size_t length = strlen(piece);
    if (t->length + length > sizeof t->at) return;
    memcpy(t->at + t->length, piece, length);
    t->length += length;
}

static void put_blanks(random_text *t)
{
    static const char *const blanks[] = {"", "", "", " ", "\n", "\t ", "\r\n"};
    put(t, blanks[draw(t, sizeof blanks / sizeof *blanks)]);
}

static void put_number(random_text *t)
{
    char text[400];
    const double x = random_between(&t->state, -1, 1) * random_power(&t->state, -30, 60);
    const int digits = (int)draw(t, 20);
    switch (draw(t, 3)) {
    case 0:
        snprintf(text, sizeof text, "%.*f", digits, x);
        break;
    case 1:
        snprintf(text, sizeof text, "%.*g", digits, x);
        break;
    default:
        snprintf(text, sizeof text, "%.*E", digits, x);
    }
    put(t, text);
}

static void put_value(random_text *t, int depth);

static void put_key(random_text *t)
{
    char key[8] = "\"a\"";
    key[1] = (char)('a' + draw(t, 26));
    put(t, key);
    put_blanks(t);
    put(t, ":");
}

static void put_list(random_text *t, int depth, bool has_keys)
{
    const uint64_t count = draw(t, 6);
    put(t, has_keys ? "{" : "[");
    for (uint64_t k = 0; k < count; ++k) {
        put_blanks(t);
        if (k > 0) put(t, ",");
        put_blanks(t);
        if (has_keys) put_key(t);
        put_value(t, depth - 1);
    }
    put_blanks(t);
    put(t, has_keys ? "}" : "]");
}

static void put_value(random_text *t, int depth)
{
    static const char *const plain[] = {
        "true", "false", "null", "\"\"", "\"x\"", "\"\xc3\xa9t\xc3\xa9\"", "-0", "0"};
    put_blanks(t);
    const uint64_t kind = draw(t, depth > 0 ? 5 : 2);
    if (kind == 0) put(t, plain[draw(t, sizeof plain / sizeof *plain)]);
    if (kind == 1) put_number(t);
    if (kind > 1) put_list(t, depth, kind == 2);
    put_blanks(t);
}

START_TEST(random_texts_are_read_as_by_jansson)
{
    random_text t = {.state = suite_seed()};
    int quick = 0;
    const int times = suite_times(20000);
    for (int k = 0; k < times; ++k) {
        t.length = 0;
        put_list(&t, 4, k % 2 == 0);
        quick += check_text(t.at, t.length);
    }
    ck_assert_msg(2 * quick > times, "only %d of %d", quick, times); /* keys may be there twice */
}
END_TEST

/* A character changed, left out, or put in. */
START_TEST(damaged_texts_are_left_to_jansson)
{
    static const char odd[] = "{}[],:\"\\+-.eE019 \ntfn\x80\xff\x01";
    random_text t = {.state = suite_seed()};
    for (int k = 0; k < suite_times(100000); ++k) {
        t.length = 0;
        put_list(&t, 3, k % 2 == 0);
        const size_t at = (size_t)draw(&t, t.length);
        if (draw(&t, 3) == 0)
            memmove(t.at + at, t.at + at + 1, --t.length - at);
        else
            t.at[at] = odd[draw(&t, sizeof odd)]; /* or a NUL */
        check_text(t.at, t.length);
        check_text(t.at, at); /* and cut off there */
    }
}
END_TEST

/* --- Single texts ----------------------------------------------------------------------------- */

START_TEST(numbers_follow_the_grammar_of_json)
{
    static const char *const good[] = {"[0]",
                                       "[-0]",
                                       "[-0.0]",
                                       "[10]",
                                       "[1e5]",
                                       "[1E+5]",
                                       "[1.5e-05]",
                                       "[0.1,-1]",
                                       "[0e1]",
                                       "[1e-400]",
                                       "[123456789012345678901234567890]",
                                       "[12345678901234567890.5]"};
    static const char *const bad[] = {"[+1]",  "[01]",  "[-01]", "[.5]",    "[5.]",  "[1.e5]",
                                      "[1e]",  "[1e+]", "[-]",   "[1e999]", "[0x1]", "[nan]",
                                      "[1 2]", "[--1]", "[1,]",  "[,1]",    "[1"};
    for (size_t k = 0; k < sizeof good / sizeof *good; ++k)
        ck_assert_msg(check_text(good[k], strlen(good[k])), "%s", good[k]);
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k)
        ck_assert_msg(!check_text(bad[k], strlen(bad[k])), "%s", bad[k]);
}
END_TEST

START_TEST(what_is_rare_is_left_to_jansson)
{
    static const char *const rare[] = {"{\"a\": 1, \"a\": 2}",
                                       "[\"\\n\"]",
                                       "[\"a\nb\"]",
                                       "1",
                                       "\"text\"",
                                       "",
                                       "  ",
                                       "{\"\xc3\xa9\": 1}",
                                       "[1] 2",
                                       "[\"\xff\"]",
                                       "[\"\xed\xa0\x80\"]",
                                       "[truE]",
                                       "[tru"};
    for (size_t k = 0; k < sizeof rare / sizeof *rare; ++k)
        ck_assert_msg(!check_text(rare[k], strlen(rare[k])), "%s", rare[k]);
    ck_assert(!check_text("[\"\0\"]", 5));
    ck_assert(check_text(" [1] \n", 6));
    char deep[400], long_key[200] = "{\"";
    for (int depth = 1; depth <= 200; ++depth) {
        memset(deep, '[', (size_t)depth);
        memset(deep + depth, ']', (size_t)depth);
        ck_assert_int_eq(check_text(deep, 2 * (size_t)depth), depth <= 64);
    }
    for (size_t length = 60; length < 70; ++length) {
        memset(long_key + 2, 'k', length);
        strcpy(long_key + 2 + length, "\": 1}");
        ck_assert_int_eq(check_text(long_key, strlen(long_key)), length < 64);
    }
}
END_TEST

START_TEST(values_are_counted_before_they_are_made)
{
    char text[40000];
    size_t length = 0;
    json_quick_end end;
    text[length++] = '[';
    while (length + 3 < sizeof text) {
        text[length++] = '1';
        text[length++] = ',';
    }
    text[length - 1] = ']';
    reading_budget narrow = {.limits = {.bytes = 100000}};
    ck_assert(json_quick_parse(text, length, &narrow, &end) == NULL && end == JSON_QUICK_LIMIT);
    ck_assert(reading_budget_is_over(&narrow));
    reading_budget wide = {.limits = {.bytes = 1000000}};
    json_t *made = json_quick_parse(text, length, &wide, &end);
    ck_assert(made != NULL && wide.bytes == 48 * json_array_size(made));
    json_decref(made);
}
END_TEST

SUITE_MAIN("json_quick", random_texts_are_read_as_by_jansson, damaged_texts_are_left_to_jansson,
           numbers_follow_the_grammar_of_json, what_is_rare_is_left_to_jansson,
           values_are_counted_before_they_are_made)
