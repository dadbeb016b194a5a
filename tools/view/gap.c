/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/gap.h"

#include <stdlib.h>
#include <string.h>

#include "tools/cli/query.h"

static imp_code begin(gap_profile *gap, size_t count, imp_error *error)
{
    *gap = (gap_profile){.t = calloc(count + 1, sizeof *gap->t),
                         .lower = calloc(count + 1, sizeof *gap->lower),
                         .upper = calloc(count + 1, sizeof *gap->upper),
                         .count = count};
    const bool room = gap->t != NULL && gap->lower != NULL && gap->upper != NULL;
    return room ? IMP_SUCCESS : mesh_no_memory(error);
}

static imp_code read_slices(const imp_query *query, gap_profile *gap, imp_error *error)
{
    imp_clearance answer;
    answer.struct_size = (uint32_t)sizeof answer;
    for (size_t k = 0; k < gap->count; ++k) {
        const imp_code code = imp_clearance_get(query, k, &answer, error);
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
    imp_code code = begin(gap, count, error);
    if (code != IMP_SUCCESS) return code;
    imp_query *query = imp_clearance_new(scene, options, &asked, error);
    if (query == NULL) return error->code;
    imp_result result;
    code = query_run(query, &result, error);
    if (code == IMP_SUCCESS) code = read_slices(query, gap, error);
    imp_query_free(query);
    return code;
}

/* Tolerance of the distance at a moment, as a part of it: three digits are shown. */
static const double moment_tolerance = 1e-3;

/* Most time for one moment, as a part of the time left. */
static const double moment_share = 0.3;

static imp_code measure_moment(imp_scene *scene, const imp_options *options, allowance *l,
                               gap_profile *gap, size_t k, imp_error *error)
{
    gap_profile one;
    imp_options moment = *options;
    moment.t_start = moment.t_end = gap->t[k];
    if (l != NULL) moment.max_seconds = allowance_left(l, moment_share);
    const imp_code code = gap_measure(scene, &moment, 1, moment_tolerance, &one, error);
    if (code == IMP_SUCCESS) gap->lower[k] = one.lower[0], gap->upper[k] = one.upper[0];
    gap_free(&one);
    return code;
}

imp_code gap_at_moments(imp_scene *scene, const imp_options *options, allowance *l, const double *t,
                        size_t count, gap_profile *gap, imp_error *error)
{
    imp_code code = begin(gap, count, error);
    if (code == IMP_SUCCESS) memcpy(gap->t, t, count * sizeof *t);
    for (size_t k = 0; k < count && code == IMP_SUCCESS; ++k)
        code = measure_moment(scene, options, l, gap, k, error);
    return code;
}

void gap_free(gap_profile *gap)
{
    free(gap->t);
    free(gap->lower);
    free(gap->upper);
    *gap = (gap_profile){0};
}
