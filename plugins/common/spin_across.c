/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/common/spin_across.h"

static imp_interval spin_of(const spin_turn *turn, int j)
{
    return imp_interval_make(turn->spin[j], turn->spin[j]);
}

/* Joins the spins of the pieces of a span; as the speed says, where these are too many to ask
 * each. */
static void spins_of(const spin_turn *turns, const spline_span *span, double speed,
                     imp_interval spin[3])
{
    enum { FEW = 16 };
    const bool many = span->last - span->first >= FEW;
    for (int j = 0; j < 3; ++j) {
        spin[j] = many ? imp_interval_make(-speed, speed) : spin_of(&turns[span->first], j);
        for (size_t k = span->first + 1; k <= span->last && !many; ++k)
            spin[j] = spline_hull(spin[j], spin_of(&turns[k], j));
    }
}

/* The integral of the spin from the middle of t on, a coordinate of it. */
static imp_model turned_since_middle(imp_interval spin, const imp_model *t)
{
    imp_series g = imp_series_around(imp_model_range(t));
    g.c[1] = imp_interval_mid(spin);
    g.e = imp_interval_radius_upper(spin, g.c[1]) * g.r * IMP_SLACK;
    const double most = imp_interval_mag(spin), far = imp_round_up(most * g.r);
    return imp_compose(t, &g, imp_interval_make(-far, far), most);
}

void spin_across(const spin_turn *turns, const spline *path, const spline_span *span,
                 const imp_interval *node, imp_model t, const imp_model x[3], imp_model out[3])
{
    const double speed = node[path->width - 2].hi, stray = node[path->width - 1].hi;
    const double r = imp_series_around(imp_model_range(&t)).r;
    const double fast = speed * (1 + 4 * SPIN_MISMATCH) + stray, most = spin_size_upper(x);
    const double slip = (0.5 * speed * fast * r + stray) * r * IMP_SLACK;
    const double drift = (speed * fast * r + stray) * most * IMP_SLACK;
    imp_model m[3][3], w[3], g[3];
    imp_interval spin[3];
    spin_matrix(&turns[span->at], path->time[span->at], imp_num(span->m), speed, m);
    spin_apply(m, x, w);
    spins_of(turns, span, speed, spin);
    for (int j = 0; j < 3; ++j) g[j] = turned_since_middle(spin[j], &t);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        imp_model sum = imp_sub(imp_mul(g[j], w[k]), imp_mul(g[k], w[j]));
        sum = imp_add(w[i], sum);
        const double e = slip * most * IMP_SLACK + IMP_TINY;
        sum.e = imp_sum_up(sum.e + e);
        sum.lo = imp_sum_down(sum.lo - e);
        sum.hi = imp_sum_up(sum.hi + e);
        sum.depends |= t.depends;
        for (int p = 0; p < 3; ++p) {
            const double rates = x[0].rate[p] + x[1].rate[p] + x[2].rate[p];
            sum.rate[p] = (sum.rate[p] + (slip * rates + drift * t.rate[p]) + IMP_TINY) * IMP_SLACK;
        }
        const double limit = imp_round_up(most * (1 + 4 * SPIN_MISMATCH));
        out[i] = imp_model_within(imp_model_finish(sum), imp_interval_make(-limit, limit));
    }
}
