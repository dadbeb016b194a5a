/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <string.h>

#include "core/surface/time_model.h"
#include "tests/support/suite.h"

/* Products of models that depend on time alone are those of models of any kind, bit for bit. */

/* A model of a size up to 2^most; some are numbers, exact or not, and some say nothing. */
static imp_model draw(uint64_t *state, double most)
{
    imp_model m = imp_model_zero();
    const double size = exp2(random_between(state, -most, most));
    switch ((int)random_between(state, 0, 10)) {
    case 0:
        return imp_num(0);
    case 1:
        return imp_num(random_between(state, 0, 1) < 0.5 ? -1 : 1);
    case 2:
        return imp_num(size * random_between(state, -1, 1));
    case 3:
        return imp_known(random_between(state, -1, 1), 0x1p-55);
    case 4:
        return imp_known(random_between(state, -1, 1), 0.1);
    case 5:
        return imp_unbounded(4);
    case 6:
        m.e = size * exp2(random_between(state, -60, 0));
        break;
    default:
        break;
    }
    m.a = size * random_between(state, -1, 1);
    m.b[2] = size * random_between(state, -1, 1);
    m.q[IMP_TT] = size * random_between(state, -1, 1);
    m.rate[2] = 2 * size;
    m.lo = -4 * size;
    m.hi = random_between(state, 0, 4) * size;
    m.depends = 4;
    return imp_model_finish(m);
}

static void check_same(const imp_model *a, const imp_model *b, int n)
{
    ck_assert_msg(memcmp(a, b, sizeof *a) == 0,
                  "seed %llu, draw %d: %a + %a t, e %a, not %a + %a t, "
                  "e %a",
                  (unsigned long long)suite_seed(), n, b->a, b->b[2], b->e, a->a, a->b[2], a->e);
}

START_TEST(products_are_those_of_models_of_any_kind)
{
    uint64_t state = suite_seed();
    const int times = suite_times(200000);
    for (int n = 0; n < times; ++n) {
        const double most = n % 8 == 0 ? 1000 : 10;
        imp_model x[3], y[3];
        for (int i = 0; i < 3; ++i) x[i] = draw(&state, most), y[i] = draw(&state, most);
        const imp_model *const at[3] = {&y[0], &y[1], &y[2]};
        const imp_model whole = imp_dot3(x, y), own = time_dot3(x, at);
        check_same(&whole, &own, n);
        const imp_interval range = imp_interval_make(-1, random_between(&state, -1, 2));
        const imp_model whole_within = imp_model_within(whole, range);
        const imp_model own_within = time_within(own, range);
        check_same(&whole_within, &own_within, n);
    }
}
END_TEST

SUITE_MAIN("time models", products_are_those_of_models_of_any_kind)
