/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_MEETING_H
#define TESTS_SUPPORT_MEETING_H

#include "core/bounds/difference.h"
#include "tests/support/suite.h"

/* What tests of pairs of made-up nodes share that meet at a chosen moment of a window: no cut may
 * lose it. */

/* A window in [0, 1] whose length may be 2^least of what is left of it, and a moment of it: an end
 * as often as one inside. */
static inline double draw_moment(uint64_t *state, double least, time_window *window)
{
    window->lo = random_between(state, 0, 0.9);
    window->hi = window->lo + (1 - window->lo) * random_power(state, least, 0);
    const uint64_t where = random_bits(state) % 4;
    return where == 0   ? window->lo
           : where == 1 ? window->hi
                        : random_between(state, window->lo, window->hi);
}

/* Whether what is left of a window holds the moment t. */
static inline void check_window_left(const time_window *window, double t, bool some,
                                     const time_window *left, int number)
{
    ck_assert_msg(some && left->lo <= t && t <= left->hi,
                  "case %d: near at %.17g of [%.17g, %.17g], left [%.17g, %.17g]", number, t,
                  window->lo, window->hi, left->lo, left->hi);
}

/* Checks the share that is left in w. */
static inline void check_share_left(const difference *r, double t, bool some, const w_range *left,
                                    int number)
{
    const long double w = r->half > 0 ? (t - (long double)r->mid) / r->half : 0;
    ck_assert_msg(some && left->lo <= w && w <= left->hi, "case %d: near at w = %Lg, left [%g, %g]",
                  number, w, left->lo, left->hi);
}

#endif
