/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SUITE_H
#define TESTS_SUPPORT_SUITE_H

#include <check.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/random.h"

/* What all Check suites share: a main, and the seed of their random numbers.
 *
 * IMPINGE_TEST_SEED replays a failure; IMPINGE_TEST_MULTIPLIER scales how often property tests
 * draw. */

static inline uint64_t suite_seed(void)
{
    const char *text = getenv("IMPINGE_TEST_SEED");
    return text != NULL ? strtoull(text, NULL, 0) : 20261120u;
}

static inline int suite_times(int usual)
{
    const char *text = getenv("IMPINGE_TEST_MULTIPLIER");
    const double factor = text != NULL ? strtod(text, NULL) : 1;
    return factor * usual < 1 ? 1 : (int)(factor * usual);
}

/* For tests that have to find something: never fewer than `least`. */
static inline int suite_times_from(int usual, int least)
{
    const int times = suite_times(usual);
    return times < least ? least : times;
}

static inline int suite_times_at_least(int usual) { return suite_times_from(usual, usual); }

static inline double random_part(uint64_t *state) { return random_between(state, -1, 1); }

/* Adds to a text, for which there is room for `size` bytes. */
__attribute__((format(printf, 3, 4))) static inline void text_add(char *text, size_t size,
                                                                  const char *format, ...)
{
    const size_t used = strlen(text);
    va_list of;
    va_start(of, format);
    vsnprintf(text + used, size - used, format, of);
    va_end(of);
}

/* An end of [-1, 1] as often as a number inside. */
static inline double suite_end_or_inside(uint64_t *state)
{
    return random_bits(state) % 2 ? random_bits(state) % 2 ? -1 : 1 : random_between(state, -1, 1);
}

/* A test that runs for _i = 0 ... end - 1. */
typedef struct suite_loop {
    const TTest *test;
    int end;
} suite_loop;

/* `open` runs before each test and `close` after it; NULL: nothing. */
static inline int suite_main_loops(const char *title, const suite_loop *loops, size_t count,
                                   void (*open)(void), void (*close)(void))
{
    Suite *suite = suite_create(title);
    TCase *tcase = tcase_create(title);
    tcase_set_timeout(tcase, 300);
    tcase_add_checked_fixture(tcase, open, close);
    for (size_t k = 0; k < count; ++k) tcase_add_loop_test(tcase, loops[k].test, 0, loops[k].end);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    if (failed > 0)
        printf("replay with IMPINGE_TEST_SEED=%llu\n", (unsigned long long)suite_seed());
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

static inline int suite_main_with(const char *title, const TTest *const *tests, size_t count,
                                  void (*open)(void), void (*close)(void))
{
    enum { TESTS_MAX = 128 };
    suite_loop loops[TESTS_MAX];
    if (count > TESTS_MAX) abort();
    for (size_t k = 0; k < count; ++k) loops[k] = (suite_loop){tests[k], 1};
    return suite_main_loops(title, loops, count, open, close);
}

static inline int suite_main(const char *title, const TTest *const *tests, size_t count)
{
    return suite_main_with(title, tests, count, NULL, NULL);
}

#define SUITE_MAIN(TITLE, ...)                                                                     \
    int main(void)                                                                                 \
    {                                                                                              \
        const TTest *const tests[] = {__VA_ARGS__};                                                \
        return suite_main(TITLE, tests, sizeof tests / sizeof tests[0]);                           \
    }

#endif
