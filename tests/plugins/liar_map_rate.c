/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include "liar.h"

/* A map's rates without time, and models without their mixed terms. */
static imp_status rate(const void *self, const imp_box4 *box, imp_map_rates *rates)
{
    const imp_status status = skew_formula_rate(self, box, rates);
    for (int i = 0; i < 3; ++i) rates->m[i][3] = 0;
    return status;
}

static imp_status apply(const void *self, const imp_model in[4], imp_model out[3])
{
    const imp_status status = skew_formula_apply(self, in, out);
    for (int i = 0; i < 3; ++i) out[i].q[IMP_UV] = 0;
    return status;
}
LIAR_MAP("liar_map_rate", skew_formula_eval, rate, apply);
