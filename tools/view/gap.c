/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/gap.h"

#include <stdlib.h>

#include "tools/cli/query.h"
#include "tools/view/mesh.h"

static imp_code read_slices(const imp_query *query, gap_profile *gap, imp_error *error)
{
    imp_clearance answer;
    answer.struct_size = (uint32_t)sizeof answer;
    for (size_t k = 0; k < gap->count; ++k) {
        const imp_code code = imp_clearance_read(query, k, &answer, error);
        if (code != IMP_SUCCESS) return code;
        gap->t[k] = answer.t_start, gap->t[k + 1] = answer.t_end;
        gap->lower[k] = answer.lower, gap->upper[k] = answer.upper;
    }
    return IMP_SUCCESS;
}

imp_code gap_measure(imp_scene *scene, const imp_options *options, size_t count, double width,
                     gap_profile *gap, imp_error *error)
{
    imp_clearance_options asked = imp_clearance_options_default();
    asked.slices = count, asked.tolerance = width;
    *gap = (gap_profile){calloc(count + 1, sizeof(double)), calloc(count, sizeof(double)),
                         calloc(count, sizeof(double)), count};
    if (gap->t == NULL || gap->lower == NULL || gap->upper == NULL) return mesh_no_memory(error);
    imp_query *query = imp_clearance_new(scene, options, &asked, error);
    if (query == NULL) return error->code;
    imp_result result;
    imp_code code = query_run(query, &result, error);
    if (code == IMP_SUCCESS) code = read_slices(query, gap, error);
    imp_query_free(query);
    return code;
}

void gap_free(gap_profile *gap)
{
    free(gap->t);
    free(gap->lower);
    free(gap->upper);
    *gap = (gap_profile){0};
}
