/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tests/support/suite.h"
#include "tools/view/palette.h"

/* Bodies are told apart by their colours. */

START_TEST(any_two_of_the_first_sixteen_colours_differ)
{
    for (size_t i = 0; i < PALETTE_FIRST; ++i)
        for (size_t j = 0; j < i; ++j) {
            const double far = palette_distance(palette_colour(i), palette_colour(j));
            ck_assert_msg(far >= PALETTE_FAR, "%zu and %zu: %g", i, j, far);
        }
}
END_TEST

START_TEST(any_two_colours_but_repetitions_differ_and_none_is_the_mark)
{
    for (size_t i = 0; i < PALETTE_COUNT; ++i) {
        ck_assert_double_ge(palette_distance(palette_colour(i), palette_mark), PALETTE_FAR);
        for (size_t j = 0; j < i; ++j)
            ck_assert_double_ge(palette_distance(palette_colour(i), palette_colour(j)),
                                PALETTE_NEAR);
    }
}
END_TEST

START_TEST(neighbours_differ_however_many_there_are)
{
    for (size_t i = 0; i < 1000; ++i)
        ck_assert_double_ge(palette_distance(palette_colour(i), palette_colour(i + 1)),
                            PALETTE_FAR);
}
END_TEST

/* Distances that B. Ottosson's page on Oklab gives the coordinates of: white is (1, 0, 0), black
 * 0. */
START_TEST(the_distance_is_that_of_oklab)
{
    const colour white = {1, 1, 1}, black = {0, 0, 0}, red = {1, 0, 0};
    ck_assert_double_eq_tol(palette_distance(white, black), 1, 1e-6);
    ck_assert_double_eq_tol(palette_distance(red, black),
                            sqrt(0.627955 * 0.627955 + 0.224863 * 0.224863 + 0.125846 * 0.125846),
                            1e-5);
}
END_TEST

SUITE_MAIN("palette", any_two_of_the_first_sixteen_colours_differ,
           any_two_colours_but_repetitions_differ_and_none_is_the_mark,
           neighbours_differ_however_many_there_are, the_distance_is_that_of_oklab)
