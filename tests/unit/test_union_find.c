/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/union_find.h"
#include "tests/support/suite.h"

enum { MEMBERS = 60 };

/* Sets by a label and a sign for each member, joined by walking over all of them. */
typedef struct labels {
    int set[MEMBERS], sign[MEMBERS];
} labels;

static bool join_labels(labels *l, size_t a, size_t b, int sign)
{
    const int from = l->set[b], turn = l->sign[a] * l->sign[b] * sign;
    if (l->set[a] == from) return turn == 1;
    for (size_t i = 0; i < MEMBERS; ++i)
        if (l->set[i] == from) l->set[i] = l->set[a], l->sign[i] *= turn;
    return true;
}

static size_t wrong_pairs(union_find *sets, const labels *l)
{
    size_t wrong = 0;
    for (size_t i = 0; i < MEMBERS; ++i)
        for (size_t k = 0; k < MEMBERS; ++k) {
            int of_i, of_k;
            const bool together =
                union_find_root(sets, i, &of_i) == union_find_root(sets, k, &of_k);
            wrong += together != (l->set[i] == l->set[k]) ||
                     (together && of_i * of_k != l->sign[i] * l->sign[k]);
        }
    return wrong;
}

START_TEST(sets_and_signs_are_those_of_labels)
{
    uint64_t state = suite_seed();
    union_find sets;
    labels l;
    size_t refused = 0;
    ck_assert(union_find_make(&sets, MEMBERS));
    for (int i = 0; i < MEMBERS; ++i) l.set[i] = i, l.sign[i] = 1;
    for (int joins = 0; joins < 4 * MEMBERS; ++joins) {
        const size_t a = random_bits(&state) % MEMBERS, b = random_bits(&state) % MEMBERS;
        const int sign = random_bits(&state) % 2 == 0 ? 1 : -1;
        const bool joined = union_find_join(&sets, a, b, sign);
        ck_assert_int_eq(joined, join_labels(&l, a, b, sign));
        refused += !joined;
        ck_assert_uint_eq(wrong_pairs(&sets, &l), 0);
    }
    ck_assert_uint_gt(refused, 0);
    union_find_clear(&sets);
}
END_TEST

SUITE_MAIN("union_find", sets_and_signs_are_those_of_labels)
