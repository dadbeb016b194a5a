/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/surface/carried.h"
#include "core/surface/region.h"

bool surface_offers_tube(const surface *s)
{
    return IMP_OFFERS(s->type, tube) && carried_exactly(s);
}

/* Whether the model is finite, keeps the promises of imp_model, and does not depend on v. */
static bool is_sane(const imp_model *m)
{
    const double *b = m->b, *q = m->q;
    double all =
        zero_if_finite(m->a) + zero_if_finite(m->e) + zero_if_finite(m->lo) + zero_if_finite(m->hi);
    for (int j = 0; j < 3; ++j) all += zero_if_finite(b[j]) + zero_if_finite(m->rate[j]);
    for (int k = 0; k < 6; ++k) all += zero_if_finite(q[k]);
    const double of_v = fabs(b[PARAMETER_V]) + fabs(q[IMP_UV]) + fabs(q[IMP_VV]) + fabs(q[IMP_VT]) +
                        fabs(m->rate[PARAMETER_V]);
    return all == 0 && of_v == 0 && (m->depends >> PARAMETER_V & 1u) == 0 && m->e >= 0 &&
           m->lo <= m->hi && m->rate[PARAMETER_U] >= 0 && m->rate[PARAMETER_T] >= 0;
}

imp_status surface_tube(const surface *s, const imp_region *region, imp_tube *tube)
{
    memset(tube, 0, sizeof *tube);
    const surface_call call = surface_call_begin(s->type->name, "tube");
    const imp_status status = surface_call_end(call, s->type->tube(s->self, region, tube));
    if (status != IMP_STATUS_OK) return status;
    for (int i = 0; i < 3; ++i)
        if (!is_sane(&tube->line[i])) return SURFACE_BAD_TUBE;
    return tube->radius >= 0 && tube->radius < INFINITY ? IMP_STATUS_OK : SURFACE_BAD_TUBE;
}
