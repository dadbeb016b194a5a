/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/survey/survey_internal.h"

static size_t range_size(const imp_survey *s) { return 2 * s->parameters * sizeof(double); }

/* --- The survey before a box ------------------------------------------------------------------ */

imp_code survey_snapshot_take(imp_survey *s, const survey_box *box, imp_error *error)
{
    survey_snapshot *m = &s->before;
    const size_t size = sizeof *box + range_size(s);
    survey_box *copy = malloc(size);
    if (copy == NULL) return error_set_memory(error);
    memcpy(copy, box, size);
    double *values = m->best.values;
    free(m->box);
    *m = (survey_snapshot){.box = copy,
                           .boxes = s->counts.boxes,
                           .proved = s->counts.proved,
                           .settled = s->counts.settled,
                           .best = s->best};
    m->best.values = memcpy(values, s->best.values, s->parameters * sizeof *values);
    return IMP_SUCCESS;
}

void survey_snapshot_drop(imp_survey *s)
{
    free(s->before.box);
    s->before.box = NULL;
}

const survey_box *survey_box_before(const imp_survey *s, const survey_box *box)
{
    return s->before.box != NULL && s->before.box->number == box->number ? s->before.box : box;
}

/* --- Records for the sink --------------------------------------------------------------------- */

struct survey_record {
    imp_survey_box box;
    double range[]; /* lo of each parameter, then hi */
};

void survey_record_box(imp_survey *s, const survey_box *box, double t_start, double t_end,
                       imp_verdict verdict, double lower)
{
    const survey_pair *pair = &s->pairs.at[box->pair];
    if (s->question.how.sink == NULL) return;
    survey_record **grown =
        array_reserve(s->records.at, s->records.count, &s->records.capacity, sizeof *grown);
    if (grown != NULL) s->records.at = grown;
    survey_record *one = grown != NULL ? malloc(sizeof *one + range_size(s)) : NULL;
    if (one == NULL) {
        s->records.failed = true;
        return;
    }
    double *lo = one->range, *hi = lo + s->parameters;
    for (size_t j = 0; j < s->parameters; ++j)
        lo[j] = box->range[2 * j], hi[j] = box->range[2 * j + 1];
    one->box = (imp_survey_box){.struct_size = (uint32_t)sizeof one->box,
                                .verdict = verdict,
                                .body = {pair->body[0], pair->body[1]},
                                .count = s->parameters,
                                .lo = lo,
                                .hi = hi,
                                .t_start = t_start,
                                .t_end = t_end,
                                .lower = lower};
    s->records.at[s->records.count++] = one;
}

imp_code survey_records_send(imp_survey *s, imp_error *error)
{
    for (size_t k = 0; k < s->records.count; ++k) {
        s->question.how.sink(s->question.how.sink_context, &s->records.at[k]->box);
        free(s->records.at[k]);
    }
    s->records.count = 0;
    return s->records.failed ? error_set_memory(error) : IMP_SUCCESS;
}

void survey_records_clear(survey_records *records)
{
    for (size_t k = 0; k < records->count; ++k) free(records->at[k]);
    free(records->at);
    *records = (survey_records){.failed = records->failed};
}
