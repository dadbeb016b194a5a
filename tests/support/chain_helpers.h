/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_CHAIN_HELPERS_H
#define TESTS_SUPPORT_CHAIN_HELPERS_H

#include "tests/support/slip_helpers.h"

/* Surfaces with a symmetry under random chains of exact motions. */

/* Maps that are rotations in exact arithmetic: spins about lines along z, shifts, and a turn that
 * takes each axis to the next. */
typedef struct chain {
    motion map[4];
    size_t count;
} chain;

static inline void draw_exact(uint64_t *random, const double center[3], motion *m)
{
    *m = (motion){.rate = 0};
    switch (random_bits(random) % 4) {
    case 0:
        *m = spin_about(center, random_between(random, -3, 3));
        break;
    case 1:
        m->rate = random_between(random, -2, 2);
        draw_vector(random, 2, m->pivot);
        memcpy(m->shift, m->pivot, sizeof m->shift);
        break;
    case 2:
        draw_vector(random, 2, m->way);
        break;
    default:
        m->place[0][1] = m->place[1][2] = m->place[2][0] = 1;
        m->is_placed = true;
        break;
    }
}

static inline void draw_chain(uint64_t *random, const double center[3], chain *c)
{
    c->count = 1 + random_bits(random) % 3;
    for (size_t k = 0; k < c->count; ++k) draw_exact(random, center, &c->map[k]);
}

static inline surface *compose_exactly(imp_symmetry *self, chain *c)
{
    surface *s = surface_new(&target, self);
    ck_assert_ptr_nonnull(s);
    for (size_t k = 0; k < c->count; ++k)
        ck_assert_int_eq(surface_add_map(s, &exactly, &c->map[k]), IMP_SUCCESS);
    return s;
}

/* Seen from before the maps of b. */
static inline void undo_all(const chain *c, long double t, long double x[3])
{
    for (size_t k = c->count; k-- > 0;) undo(&c->map[k], t, x);
}

static inline imp_region draw_times(uint64_t *random)
{
    const double from = random_between(random, -1, 1);
    return region_make((double[3]){0, 0, from},
                       (double[3]){1, 1, from + random_power(random, -6, 1)});
}

static inline imp_symmetry draw_symmetry(uint64_t *random)
{
    imp_symmetry s = {.kind = 1 + (uint32_t)(random_bits(random) % 4)};
    s.axis[2] = random_power(random, -4, 4);
    draw_vector(random, 1, s.center);
    return s;
}

#endif
