/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "core/base/status.h"
#include "core/survey/survey_proof.h"

bool box_is_unmoved(const survey_pair *pair) { return pair->body[0] == SURVEY_ALL_BODIES; }

bool box_is_swept(const survey_pair *pair) { return pair->swept != SIZE_MAX; }

void box_name_side(const survey_pair *pair, imp_side *a, imp_side *b)
{
    if (box_is_unmoved(pair)) return;
    a->body = pair->body[a->body];
    b->body = pair->body[b->body];
}

void box_keep_values(imp_survey *s, const survey_pair *pair, const double *values, double *t)
{
    memmove(s->best.values, values, s->parameters * sizeof *values);
    s->best.is_known = true;
    if (!box_is_swept(pair)) return;
    s->best.values[pair->swept] = *t;
    *t = s->question.options.t_start;
}

void survey_add_proved(imp_survey *s, const survey_box *box, double share)
{
    s->counts.proved += share;
    s->pairs.at[box->pair].proved += share;
}

/* Chooses the parameter that shifts most; where several have no bound, the one whose range is
 * widest beside that of the scene. Returns s->parameters if no range can be halved. */
static size_t choose_split(const imp_survey *s, const box_bounds *bounds)
{
    size_t best = s->parameters;
    double most = 0, widest = 0;
    for (size_t j = 0; j < s->parameters; ++j) {
        const double wide = (bounds->hi[j] - bounds->lo[j]) / (s->hi[j] - s->lo[j]);
        const double shift = s->box.shift[0][j] >= 0 ? s->box.shift[0][j] : INFINITY;
        if (!(bounds->lo[j] < s->box.middle[j] && s->box.middle[j] < bounds->hi[j]) || shift == 0)
            continue;
        if (best < s->parameters && !(shift > most || (shift == most && wide > widest))) continue;
        best = j;
        most = shift;
        widest = wide;
    }
    return best;
}

imp_code box_split(imp_survey *s, const survey_box *box, const box_bounds *bounds, bool *done,
                   imp_error *error)
{
    const size_t j = choose_split(s, bounds),
                 size = sizeof *box + 2 * s->parameters * sizeof *box->range;
    *done = j < s->parameters;
    if (*done) s->counts.cuts[j] += 1;
    const imp_code code =
        *done ? survey_proof_halve(s, box, j, s->counts.made, error) : IMP_SUCCESS;
    if (code != IMP_SUCCESS) return code;
    for (int side = 0; *done && side < 2; ++side) {
        survey_box *half = malloc(size);
        if (half == NULL) return error_set_memory(error);
        memcpy(half, box, size);
        half->number = s->counts.made++;
        half->share = 0.5 * box->share;
        half->range[2 * j + (side == 0)] = s->box.middle[j];
        if (!box_queue_push(&s->queue, half)) return error_set_memory(error);
    }
    return IMP_SUCCESS;
}

imp_code box_measure(imp_survey *s, const survey_box *box, box_bounds *bounds, imp_error *error)
{
    const survey_pair *pair = &s->pairs.at[box->pair];
    const query_times all = {s->question.options.t_start, s->question.options.t_end};
    const query_times times = box_is_swept(pair) ? all : box_times(s, box);
    return survey_measure(s, box, pair->left_out, times.start, times.end, bounds, error);
}

imp_code survey_ask(imp_survey *s, survey_box *box, imp_error *error)
{
    box_state state = BOX_OPEN;
    imp_code code = survey_snapshot_take(s, box, error);
    if (code != IMP_SUCCESS) return free(box), code;
    s->counts.boxes += 1;
    s->pairs.at[box->pair].boxes += 1;
    s->box.key = s->question.is_distance ? s->question.options.t_start : box->key;
    const uint64_t before = s->counts.stats.pairs;
    code = s->question.is_distance ? box_ask_distance(s, box, &state, error)
                                   : box_ask_contact(s, box, &state, error);
    s->pairs.at[box->pair].pairs += s->counts.stats.pairs - before;
    if (!box_is_limit(s->reason)) {
        survey_snapshot_drop(s);
        if (code == IMP_SUCCESS) code = survey_records_send(s, error);
    }
    if (code != IMP_SUCCESS || state != BOX_WAITING) return free(box), code;
    return box_queue_push(&s->queue, box) ? IMP_SUCCESS : error_set_memory(error);
}
