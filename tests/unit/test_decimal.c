/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <inttypes.h>

#include <impinge/decimal.h>

#include "tests/support/suite.h"

/* Numbers of texts are those that strtod reads, to the last bit. */

static void check_number(const char *word)
{
    char *end;
    double x = 0;
    const double y = strtod(word, &end);
    const bool is_number = imp_decimal_number(word, strlen(word), &x);
    ck_assert_msg(is_number == isfinite(y), "%s", word);
    ck_assert_msg(*end == '\0', "%s", word);
    if (!is_number) return;
    if (memcmp(&x, &y, sizeof x) != 0) ck_abort_msg("%s: got %.17g, strtod %.17g", word, x, y);
}

static double random_double(uint64_t *state)
{
    const uint64_t bits = random_bits(state);
    double x;
    memcpy(&x, &bits, sizeof x);
    return isfinite(x) ? x : 0;
}

START_TEST(numbers_as_programs_write_them)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(400000); ++k) {
        char word[400];
        const double x = random_between(&state, -1, 1) * random_power(&state, -60, 60);
        snprintf(word, sizeof word, "%.*g", (int)(random_bits(&state) % 20), x);
        check_number(word);
        snprintf(word, sizeof word, "%.*f", (int)(random_bits(&state) % 24), x);
        check_number(word);
        snprintf(word, sizeof word, "%.*e", (int)(random_bits(&state) % 24), random_double(&state));
        check_number(word);
    }
}
END_TEST

/* All lengths of digits, points anywhere, and exponents beyond those that need no strtod. */
START_TEST(numbers_of_any_digits)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(1000000); ++k) {
        char digits[32], word[64];
        const int wanted = 1 + (int)(random_bits(&state) % 20);
        for (int i = 0; i < wanted; ++i) digits[i] = (char)('0' + random_bits(&state) % 10);
        digits[wanted] = '\0';
        const int point = (int)(random_bits(&state) % (unsigned)(wanted + 1));
        const int power = (int)(random_bits(&state) % 71) - 35;
        snprintf(word, sizeof word, "%s%.*s.%se%d", power % 2 == 0 ? "-" : "", point, digits,
                 digits + point, power);
        check_number(word);
    }
}
END_TEST

/* Decimal numbers between two doubles: in the middle, and one unit of the last digit beside it. The
 * middle of m and m + 1 times 2^k is (2 m + 1) 2^(k - 1). */
START_TEST(halves_are_rounded_to_even)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(100000); ++k) {
        const uint64_t odd = (random_bits(&state) >> 10 | UINT64_C(1) << 53) | 1; /* 54 bits */
        for (int up = 0; up <= 9; ++up)
            for (int step = -1; step <= 1; ++step) {
                char word[64];
                snprintf(word, sizeof word, "%" PRIu64, (odd << up) + (uint64_t)step);
                check_number(word);
            }
        for (uint64_t down = 1, five = 5; down <= 3; ++down, five *= 5)
            for (int step = -1; step <= 1; ++step) {
                char word[64];
                snprintf(word, sizeof word, "%" PRIu64 "e-%" PRIu64, odd * five + (uint64_t)step,
                         down);
                check_number(word);
            }
    }
}
END_TEST

/* The 19 digits that are nearest to the middle of two doubles. */
START_TEST(nearly_halves_are_rounded_to_the_nearer)
{
    uint64_t state = suite_seed();
    for (int k = 0; k < suite_times(300000); ++k) {
        char word[64], near[64];
        const double x = random_fraction(&state) * random_power(&state, -60, 120);
        const long double middle = ((long double)x + nextafter(x, INFINITY)) / 2;
        snprintf(word, sizeof word, "%.18Le", middle);
        check_number(word);
        const char digit = word[19]; /* the last */
        strcpy(near, word);
        near[19] = (char)(digit == '9' ? '8' : digit + 1);
        check_number(near);
        near[19] = (char)(digit == '0' ? '1' : digit - 1);
        check_number(near);
    }
}
END_TEST

START_TEST(numbers_at_the_ends)
{
    static const char *const words[] = {
        "0",
        "-0",
        "+0.0",
        "0e999",
        "-0e-5000",
        "00000000000000000000000000000000",
        ".5",
        "5.",
        "-.25",
        "18446744073709551615",
        "18446744073709551616",
        "9999999999999999999",
        "9999999999999999999e27",
        "9999999999999999999e-27",
        "9999999999999999999e28",
        "1e-28",
        "1e22",
        "1e23",
        "9007199254740993",
        "9007199254740993e0",
        "9007199254740992.5",
        "0.00000000000000000000000012345678901234567890",
        "0000000000000000000001234567890123456789",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.2250738585072011e-308",
        "1.7976931348623157e308",
        "1.7976931348623159e308",
        "1e308",
        "1e309",
        "1e00000000000000000001",
        "8.5070591730234616e37",
    };
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) check_number(words[k]);
}
END_TEST

START_TEST(what_is_no_number_is_none)
{
    static const char *const words[] = {
        "",    "-",   "+",   ".",   "-.", "1.2.3", "1-2", "--1",  "+-1", "1e",           "1e+",
        "0x1", "nan", "inf", "1,5", "e5", " 1",    "1 ",  "1e5.", "1f",  "\357\273\2771"};
    double x;
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k)
        ck_assert_msg(!imp_decimal_number(words[k], strlen(words[k]), &x), "%s", words[k]);
    char longest[101];
    memset(longest, '1', 100);
    ck_assert(imp_decimal_number(longest, 99, &x) && x == 1.1111111111111112e98);
    ck_assert(!imp_decimal_number(longest, 100, &x));
    ck_assert(imp_decimal_number("12345", 3, &x) && x == 123); /* and reads no further */
}
END_TEST

SUITE_MAIN("decimal", numbers_as_programs_write_them, numbers_of_any_digits,
           halves_are_rounded_to_even, nearly_halves_are_rounded_to_the_nearer, numbers_at_the_ends,
           what_is_no_number_is_none)
