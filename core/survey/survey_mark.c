/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/common/array.h"
#include "core/survey/survey_internal.h"

static size_t range_size(const imp_survey *s) { return 2 * s->count * sizeof(double); }

/* --- Marks ------------------------------------------------------------------------------------ */

imp_code survey_mark_take(imp_survey *s, const survey_box *box, imp_error *error)
{
    survey_mark *m = &s->mark;
    const size_t size = sizeof *box + range_size(s);
    survey_box *copy = malloc(size);
    if (copy == NULL) return error_set_memory(error);
    memcpy(copy, box, size);
    double *values = m->best.values;
    free(m->box);
    *m = (survey_mark){.box = copy,
                       .boxes = s->boxes,
                       .proved = s->proved,
                       .settled = s->settled,
                       .best = s->best};
    m->best.values = memcpy(values, s->best.values, s->count * sizeof *values);
    return IMP_SUCCESS;
}

void survey_mark_drop(imp_survey *s)
{
    free(s->mark.box);
    s->mark.box = NULL;
}

const survey_box *survey_marked(const imp_survey *s, const survey_box *box)
{
    return s->mark.box != NULL && s->mark.box->number == box->number ? s->mark.box : box;
}

/* --- What the sink is told -------------------------------------------------------------------- */

struct survey_told {
    imp_survey_box box;
    double range[]; /* lo of each parameter, then hi */
};

void survey_tell(imp_survey *s, const survey_box *box, double t_start, double t_end,
                 imp_verdict verdict, double lower)
{
    const survey_pair *pair = &s->pairs[box->pair];
    if (s->how.sink == NULL) return;
    survey_told **grown = array_reserve(s->told, s->told_count, &s->told_capacity, sizeof *grown);
    if (grown != NULL) s->told = grown;
    survey_told *one = grown != NULL ? malloc(sizeof *one + range_size(s)) : NULL;
    if (one == NULL) {
        s->told_failed = true;
        return;
    }
    double *lo = one->range, *hi = lo + s->count;
    for (size_t j = 0; j < s->count; ++j) lo[j] = box->range[2 * j], hi[j] = box->range[2 * j + 1];
    one->box = (imp_survey_box){.struct_size = (uint32_t)sizeof one->box,
                                .verdict = verdict,
                                .body = {pair->body[0], pair->body[1]},
                                .count = s->count,
                                .lo = lo,
                                .hi = hi,
                                .t_start = t_start,
                                .t_end = t_end,
                                .lower = lower};
    s->told[s->told_count++] = one;
}

imp_code survey_flush(imp_survey *s, imp_error *error)
{
    for (size_t k = 0; k < s->told_count; ++k) {
        s->how.sink(s->how.sink_context, &s->told[k]->box);
        free(s->told[k]);
    }
    s->told_count = 0;
    return s->told_failed ? error_set_memory(error) : IMP_SUCCESS;
}

void survey_told_clear(imp_survey *s)
{
    for (size_t k = 0; k < s->told_count; ++k) free(s->told[k]);
    free(s->told);
    s->told = NULL;
    s->told_count = 0;
}
