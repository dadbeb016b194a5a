/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/nearest.h"

#include "tools/cli/query.h"

/* Tolerance of the distance, as a part of it: three digits are shown. */
static const double tolerance = 1e-3;

stage_spot nearest_of(const imp_clearance *answer, double gamma)
{
    if (!answer->has_witness) return (stage_spot){.is_known = false};
    return (stage_spot){.is_known = true,
                        .is_contact = answer->upper <= gamma,
                        .t = answer->t,
                        .point = {vec_of(answer->a.point), vec_of(answer->b.point)},
                        .body = {answer->a.body, answer->b.body},
                        .has_normal = answer->has_normal,
                        .normal = vec_of(answer->normal),
                        .lower = answer->lower,
                        .upper = answer->upper};
}

imp_code nearest_find(imp_scene *scene, const imp_options *options, stage_spot *spot,
                      imp_error *error)
{
    imp_clearance_options asked = imp_clearance_options_default();
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    imp_result result;
    asked.tolerance = tolerance;
    *spot = (stage_spot){.is_known = false};
    imp_query *query = imp_clearance_new(scene, options, &asked, error);
    if (query == NULL) return error->code;
    imp_code code = query_run(query, &result, error);
    if (code == IMP_SUCCESS && imp_clearance_count(query) > 0)
        code = imp_clearance_get(query, 0, &answer, error);
    if (code == IMP_SUCCESS) *spot = nearest_of(&answer, options->gamma);
    imp_query_free(query);
    return code;
}
