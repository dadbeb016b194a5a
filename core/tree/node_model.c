/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/tree/node_model.h"

#include "core/tree/model_lanes.h"

/* Returns the first promise of imp_model that a coordinate breaks, or NULL. Infinite values come
 * only with IMP_STATUS_UNBOUNDED. */
static const char *breach_of(const imp_model *m, bool may_be_infinite)
{
    const double limit = may_be_infinite ? INFINITY : 0x1.fffffffffffffp1023;
    if (!(m->e >= 0)) return "the remainder is negative or NaN";
    if (!(m->lo <= m->hi)) return "the range is inverted or NaN";
    if (m->e > limit || m->hi > limit || -m->lo > limit) return "a bound is infinite";
    double sum = fabs(m->a);
    for (int j = 0; j < 3; ++j) sum += fabs(m->b[j]);
    for (int k = 0; k < 6; ++k) sum += fabs(m->q[k]);
    if (!(sum <= limit) && !may_be_infinite) return "a coefficient is infinite or NaN";
    for (int j = 0; j < 3; ++j)
        if (!may_be_infinite && !(m->rate[j] >= 0 && m->rate[j] <= limit))
            return "a rate is negative, infinite or NaN";
    return NULL;
}

static const char *first_breach(const imp_model model[3], bool may_be_infinite)
{
    const char *breach = NULL;
    for (int i = 0; i < 3 && breach == NULL; ++i) breach = breach_of(&model[i], may_be_infinite);
    return breach;
}

IMP_QUAD_INLINE const char *take(node *n, const imp_model model[3], bool may_be_infinite)
{
    model_lanes m;
    lanes_gather(model, &m);
    const bool bounded = lanes_are_bounded(&m);
    if (!bounded || !lanes_are_sound(&m)) {
        const char *breach = first_breach(model, may_be_infinite);
        if (breach != NULL) return breach;
    }
    lanes_take(n, &m);
    n->bounded = bounded;
    if (!bounded) {
        memcpy(n->extent, n->region.d, sizeof n->extent);
        memcpy(n->nonlinear_extent, n->region.d, sizeof n->nonlinear_extent);
    }
    return NULL;
}

IMP_QUAD_WIDE static const char *take_wide(node *n, const imp_model model[3], bool may_be_infinite)
{
    return take(n, model, may_be_infinite);
}

void node_add_ball(node *n, double ball)
{
    memcpy(n->posed_e, n->e, sizeof n->posed_e);
    lanes_add_ball(n, ball);
}

const char *node_take_model(node *n, const imp_model model[3], bool may_be_infinite)
{
    return imp_quad_is_wide() ? take_wide(n, model, may_be_infinite)
                              : take(n, model, may_be_infinite);
}
