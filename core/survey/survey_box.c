/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/survey/box_question.h"

bool box_is_rest(const survey_pair *pair) { return pair->body[0] == SURVEY_ALL_BODIES; }

bool box_is_swept(const survey_pair *pair) { return pair->swept != SIZE_MAX; }

void box_name_side(const survey_pair *pair, imp_side *a, imp_side *b)
{
    if (box_is_rest(pair)) return;
    a->body = pair->body[a->body];
    b->body = pair->body[b->body];
}

void box_keep_values(imp_survey *s, const survey_box *box, double *t)
{
    const survey_pair *pair = &s->pairs[box->pair];
    memcpy(s->best.values, s->at, s->count * sizeof *s->at);
    s->best.is_known = true;
    if (!box_is_swept(pair)) return;
    s->best.values[pair->swept] = *t;
    *t = s->options.t_start;
}

void survey_add_proved(imp_survey *s, const survey_box *box, double share)
{
    s->proved += share;
    s->pairs[box->pair].proved += share;
}

/* Chooses the parameter that shifts most; where several have no bound, the one whose range is
 * widest beside that of the scene. Returns s->count if no range can be halved. */
static size_t choose_split(const imp_survey *s, const survey_view *view)
{
    size_t best = s->count;
    double most = 0, widest = 0;
    for (size_t j = 0; j < s->count; ++j) {
        const double wide = (view->hi[j] - view->lo[j]) / (s->hi[j] - s->lo[j]);
        const double shift = s->shift[0][j] >= 0 ? s->shift[0][j] : INFINITY;
        if (!(view->lo[j] < s->at[j] && s->at[j] < view->hi[j]) || shift == 0) continue;
        if (best < s->count && !(shift > most || (shift == most && wide > widest))) continue;
        best = j;
        most = shift;
        widest = wide;
    }
    return best;
}

imp_code box_split(imp_survey *s, const survey_box *box, const survey_view *view, bool *done,
                   imp_error *error)
{
    const size_t j = choose_split(s, view), size = sizeof *box + 2 * s->count * sizeof *box->range;
    *done = j < s->count;
    if (*done) s->cuts[j] += 1;
    for (int side = 0; *done && side < 2; ++side) {
        survey_box *half = malloc(size);
        if (half == NULL) return error_set_memory(error);
        memcpy(half, box, size);
        half->number = s->made++;
        half->share = 0.5 * box->share;
        half->range[2 * j + (side == 0)] = s->at[j];
        if (!box_queue_push(&s->queue, half)) return error_set_memory(error);
    }
    return IMP_SUCCESS;
}

imp_code box_measure(imp_survey *s, const survey_box *box, survey_view *view, imp_error *error)
{
    const survey_pair *pair = &s->pairs[box->pair];
    const query_times all = {s->options.t_start, s->options.t_end};
    const query_times times = box_is_swept(pair) ? all : box_times(s, box);
    return survey_measure(s, box, pair->left_out, times.start, times.end, view, error);
}

imp_code survey_ask(imp_survey *s, survey_box *box, imp_error *error)
{
    box_rest rest = BOX_OPEN;
    imp_code code = survey_mark_take(s, box, error);
    if (code != IMP_SUCCESS) return free(box), code;
    s->boxes += 1;
    s->pairs[box->pair].boxes += 1;
    s->key_asked = s->is_distance ? s->options.t_start : box->key;
    const uint64_t before = s->stats.pairs;
    code = s->is_distance ? box_ask_distance(s, box, &rest, error)
                          : box_ask_contact(s, box, &rest, error);
    s->pairs[box->pair].pairs += s->stats.pairs - before;
    if (!box_is_limit(s->reason)) {
        survey_mark_drop(s);
        if (code == IMP_SUCCESS) code = survey_flush(s, error);
    }
    if (code != IMP_SUCCESS || rest != BOX_WAITING) return free(box), code;
    return box_queue_push(&s->queue, box) ? IMP_SUCCESS : error_set_memory(error);
}
