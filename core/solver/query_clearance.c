/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/fp_mode.h"
#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/solver/query_internal.h"

/* Bytes of the first version. */
#define OPTIONS_FIRST offsetof(imp_clearance_options, decide)
#define ANSWER_FIRST sizeof(imp_clearance)

static const imp_clearance_options usual = {
    .struct_size = (uint32_t)sizeof usual, .tolerance = 1e-3, .slices = 1};

imp_code imp_clearance_options_get_default(imp_clearance_options *asked, imp_error *error)
{
    const imp_code code = sized_check("imp_clearance_options", asked, OPTIONS_FIRST, error);
    if (code == IMP_SUCCESS) sized_write(asked, &usual);
    return code;
}

FP_APART static imp_code add_clearance(imp_query *query, const imp_clearance_options *asked,
                                       imp_error *error)
{
    imp_clearance_options own = usual;
    imp_code code = IMP_SUCCESS;
    if (asked != NULL)
        code = sized_read("imp_clearance_options", &own, asked, OPTIONS_FIRST, error);
    return code != IMP_SUCCESS
               ? code
               : clearance_new(query->scene, query->examined.any_pair, &query->options, &own,
                               &query->watch, &query->clearance, error);
}

imp_query *imp_clearance_new(imp_scene *scene, const imp_options *options,
                             const imp_clearance_options *asked, imp_error *error)
{
    const fp_environment environment = fp_environment_enter();
    imp_query *query = imp_query_new(scene, options, error);
    if (query != NULL && add_clearance(query, asked, error) != IMP_SUCCESS) {
        imp_query_free(query);
        query = NULL;
    }
    fp_environment_leave(&environment);
    return query;
}

size_t imp_clearance_count(const imp_query *query)
{
    return query != NULL && query->clearance != NULL ? clearance_count(query->clearance) : 0;
}

FP_APART static imp_code read_answer(const imp_query *query, size_t index, imp_clearance *answer,
                                     imp_error *error)
{
    const imp_code code = sized_check("imp_clearance", answer, ANSWER_FIRST, error);
    if (code != IMP_SUCCESS) return code;
    const size_t count = imp_clearance_count(query);
    if (index >= count)
        return error_set(error, IMP_ERROR_USAGE, "answer: got %zu, must be below %zu", index,
                         count);
    imp_clearance own;
    const imp_code read = clearance_answer(query->clearance, index, query->reason, &own, error);
    if (read == IMP_SUCCESS) sized_write(answer, &own);
    return read;
}

imp_code imp_clearance_get(const imp_query *query, size_t index, imp_clearance *answer,
                           imp_error *error)
{
    if (query == NULL) return error_set_missing(error, "imp_clearance_get");
    const fp_environment environment = fp_environment_enter();
    const imp_code code = read_answer(query, index, answer, error);
    fp_environment_leave(&environment);
    return code;
}
