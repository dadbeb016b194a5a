/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/proof/polynomial.h"

static void add_term(jet *sum, const jet *x, double k)
{
    const jet term = jet_scale(x, ld_interval_of(k));
    *sum = jet_add(sum, &term);
}

jet polynomial_jet(const imp_model *g, double cubic, const jet s[3])
{
    jet both, sum = jet_constant(3, ld_interval_of(g->a));
    for (int j = 0; j < 3; ++j)
        if (g->b[j] != 0) add_term(&sum, &s[j], g->b[j]);
    for (int j = 0, m = 0; j < 3; ++j)
        for (int k = j; k < 3; ++k, ++m) {
            if (g->q[m] == 0) continue;
            both = j == k ? jet_apply(jet_sqr_, &s[j]) : jet_mul(&s[j], &s[k]);
            add_term(&sum, &both, g->q[m]);
        }
    if (cubic == 0) return sum;
    both = jet_mul(&s[0], &s[1]);
    both = jet_mul(&both, &s[2]);
    add_term(&sum, &both, cubic);
    return sum;
}
