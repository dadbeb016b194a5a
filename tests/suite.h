/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUITE_H
#define TESTS_SUITE_H

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* What all Check suites share: a main, and seeded random numbers.
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

/* splitmix64: the same numbers on every machine. */
static inline uint64_t suite_bits(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline double suite_between(uint64_t *state, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(suite_bits(state) >> 11) * 0x1p-53);
}

/* 2^k, k uniform in [lo, hi] */
static inline double suite_power(uint64_t *state, double lo, double hi)
{
    return exp2(suite_between(state, lo, hi));
}

static inline int suite_main(const char *title, const TTest *const *tests, size_t count)
{
    Suite *suite = suite_create(title);
    TCase *tcase = tcase_create(title);
    tcase_set_timeout(tcase, 300);
    for (size_t k = 0; k < count; ++k) tcase_add_test(tcase, tests[k]);
    suite_add_tcase(suite, tcase);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_ENV);
    const int failed = srunner_ntests_failed(runner);
    if (failed > 0)
        printf("replay with IMPINGE_TEST_SEED=%llu\n", (unsigned long long)suite_seed());
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

#define SUITE_MAIN(TITLE, ...)                                                                     \
    int main(void)                                                                                 \
    {                                                                                              \
        const TTest *const tests[] = {__VA_ARGS__};                                                \
        return suite_main(TITLE, tests, sizeof tests / sizeof tests[0]);                           \
    }

#endif
