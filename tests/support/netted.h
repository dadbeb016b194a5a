/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_NETTED_H
#define TESTS_SUPPORT_NETTED_H

#include <string.h>

#include "core/common/random.h"
#include "core/tree/node.h"
#include "tests/support/suite.h"

/* Nodes that have a random control net and nothing else. */

typedef struct netted {
    imp_net given;
    net_buffer room;
    node n;
} netted;

static inline void draw_net(uint64_t *state, uint32_t n, uint32_t m, double far, netted *made)
{
    imp_net *g = &made->given;
    memset(g, 0, sizeof *g);
    g->degree[0] = n, g->degree[1] = m;
    g->is_moving = random_bits(state) % 4 != 0;
    g->is_weighted = random_bits(state) % 3 == 0;
    for (int i = 0; i < 3; ++i) {
        g->place[i] = far * random_between(state, -1, 1);
        g->drift[i] = random_between(state, -2, 2);
        for (int k = 0; k < IMP_NET_POINTS; ++k) {
            g->point[i][k] = random_between(state, -1, 1);
            g->velocity[i][k] = random_between(state, -1, 1);
            g->weight[k] = random_power(state, -4, 4);
        }
    }
}

static inline void take(netted *made, const double lo[3], const double hi[3])
{
    made->n = (node){.region = region_make(lo, hi)};
    ck_assert(net_take(net_in(&made->room), &made->given, &made->n.region));
    made->n.net = net_in(&made->room);
}

/* What the host keeps, as a type would give it. */
static inline imp_net given_by(const net *f)
{
    imp_net g = {.degree = {(uint32_t)f->degree[0], (uint32_t)f->degree[1]},
                 .is_moving = f->is_moving,
                 .is_weighted = f->is_weighted};
    const int points = (f->degree[0] + 1) * (f->degree[1] + 1), columns = f->is_moving ? 6 : 3;
    for (int i = 0; i < 3; ++i) {
        g.place[i] = f->place[i], g.drift[i] = f->drift[i], g.error[i] = f->error[i];
        for (int k = 0; k < points; ++k) {
            g.point[i][k] = f->numbers[i * f->stride + k];
            if (f->is_moving) g.velocity[i][k] = f->numbers[(3 + i) * f->stride + k];
            g.weight[k] = f->is_weighted ? f->numbers[columns * f->stride + k] : 1;
        }
    }
    return g;
}

#endif
