/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_PLUGINS_SLACK_NET_H
#define TESTS_PLUGINS_SLACK_NET_H

#include "liar.h"

/* A true net of the liars' surface, though it is no Bezier patch: one point, the middle of the
 * range that rates leave, and an error as large as half of it. Over tiny regions the surface comes
 * near both ends. */
static inline imp_status slack_net(const void *self, const imp_region *region, imp_net *out)
{
    imp_model model[3];
    const imp_status status = wavy_formula_include(self, region, model);
    if (status != IMP_STATUS_OK) return IMP_STATUS_UNBOUNDED;
    for (int i = 0; i < 3; ++i) {
        out->place[i] = model[i].a;
        out->error[i] = model[i].e;
        for (int j = 0; j < 3; ++j) out->error[i] += fabs(model[i].b[j]);
        for (int k = 0; k < 6; ++k) out->error[i] += fabs(model[i].q[k]);
    }
    return IMP_STATUS_OK;
}

/* Truthful but for its net, perhaps. */
#define LIAR_NET(NAME, NET)                                                                        \
    LIAR_TYPE(NAME, tiny_create, tiny_destroy, wavy_formula_eval, wavy_formula_rate,               \
              wavy_formula_include, NET)

#endif
