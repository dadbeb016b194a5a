/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <string.h>

#include "core/base/sized.h"
#include "core/base/status.h"
#include "core/survey/survey_internal.h"

/* Where the boxes of a survey went. */

imp_code imp_survey_get_cost(const imp_survey *s, size_t index, imp_survey_cost *cost,
                             imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_get_cost");
    const imp_code code = sized_check("imp_survey_cost", cost, sizeof *cost, error);
    if (code != IMP_SUCCESS) return code;
    if (index >= s->pairs.count)
        return error_set(error, IMP_ERROR_USAGE, "index: got %zu, must be below %zu", index,
                         s->pairs.count);
    const survey_pair *pair = &s->pairs.at[index];
    const imp_survey_cost own = {.struct_size = (uint32_t)sizeof own,
                                 .body = {pair->body[0], pair->body[1]},
                                 .boxes = pair->boxes,
                                 .pairs = pair->pairs,
                                 .proved = pair->proved};
    sized_write(cost, &own);
    return IMP_SUCCESS;
}

void imp_survey_cuts(const imp_survey *s, uint64_t *cuts)
{
    if (s != NULL && cuts != NULL) memcpy(cuts, s->counts.cuts, s->parameters * sizeof *cuts);
}
