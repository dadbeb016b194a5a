/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/json_text.h"
#include "core/base/status.h"
#include "core/survey/box_question.h"

/* Where a survey stands, as text
 * ==============================
 * {"question", "boxes": N, "made": N, "proved": P, "settled": L, "waiting": [...], "known"};
 * "question" is what has to be equal in the survey that goes on: ranges, pairs, tolerances. A box
 * that waits is [key, number, pair, share, near, cost, limit, lo, hi, ...], "known" the incumbent.
 * Numbers are written with 17 digits and read back exactly; null stands for INFINITY. */

/* --- Writing ---------------------------------------------------------------------------------- */

static json_t *number_json(double x) { return x < INFINITY ? json_real(x) : json_null(); }

/* False: no memory. It takes over `item`. */
static bool append(json_t *array, json_t *item) { return json_array_append_new(array, item) == 0; }

static bool append_numbers(json_t *array, const double *x, size_t count)
{
    for (size_t k = 0; k < count; ++k)
        if (!append(array, number_json(x[k]))) return false;
    return true;
}

/* Everything that decides which boxes there are and what is asked of them. NULL: no memory. */
static json_t *question_json(const imp_survey *s)
{
    const survey_question *q = &s->question;
    const double asked[] = {q->gamma, q->gamma_clear, q->options.t_start, q->options.t_end};
    const double wanted[] = {q->clearance.required, q->clearance.tolerance, q->is_clearance};
    const double rest[] = {q->is_distance, q->how.any, (double)s->parameters,
                           (double)s->pairs.count};
    json_t *list = json_array();
    bool kept = append_numbers(list, asked, 4) && append_numbers(list, wanted, 3) &&
                append_numbers(list, rest, 4);
    for (size_t j = 0; j < s->parameters; ++j)
        kept = kept && append(list, json_string(scene_parameters_read(s->scene)->at[j].name)) &&
               append(list, json_real(s->lo[j])) && append(list, json_real(s->hi[j]));
    for (size_t k = 0; k < s->pairs.count; ++k)
        for (int side = 0; side < 2; ++side)
            kept = kept && append(list, json_integer((json_int_t)s->pairs.at[k].body[side]));
    if (kept) return list;
    json_decref(list);
    return NULL;
}

enum { BOX_NUMBERS = 7 }; /* of a box, before its ranges */

static json_t *box_json(const survey_box *box, size_t count)
{
    json_t *list = json_pack("[o, I, I, f, o, I, I]", number_json(box->key),
                             (json_int_t)box->number, (json_int_t)box->pair, box->share,
                             number_json(box->near), (json_int_t)box->cost, (json_int_t)box->limit);
    if (list == NULL || append_numbers(list, box->range, 2 * count)) return list;
    json_decref(list);
    return NULL;
}

static json_t *waiting_json(const imp_survey *s)
{
    json_t *list = json_array();
    for (size_t k = 0; k < s->queue.count; ++k)
        if (!append(list, box_json(survey_box_before(s, s->queue.at[k]), s->parameters)))
            return json_decref(list), NULL;
    return list;
}

static json_t *side_json(const imp_side *side)
{
    return json_pack("[I, I, I, f, f, f, f, f]", (json_int_t)side->body, (json_int_t)side->surface,
                     (json_int_t)side->piece, side->u, side->v, side->point[0], side->point[1],
                     side->point[2]);
}

/* The witness, of a contact or of a least distance. */
typedef struct known_witness {
    double t, length;
    imp_side a, b;
    bool has_normal, at_rest;
    double normal[3];
    int kind;
} known_witness;

static known_witness witness_of(const imp_survey *s, const survey_incumbent *best)
{
    const imp_result *r = &best->contact;
    const imp_clearance *c = &best->nearest;
    known_witness w = {.t = r->t, .length = r->gap, .a = r->a, .b = r->b};
    w.has_normal = r->has_normal, w.at_rest = r->at_rest, w.kind = (int)r->kind;
    memcpy(w.normal, r->normal, sizeof w.normal);
    if (!s->question.is_distance) return w;
    w = (known_witness){.t = c->t, .length = c->upper, .a = c->a, .b = c->b};
    w.has_normal = c->has_normal, w.kind = (int)c->kind;
    memcpy(w.normal, c->normal, sizeof w.normal);
    return w;
}

static json_t *known_json(const imp_survey *s, const survey_incumbent *best)
{
    if (!best->is_known) return json_null();
    const known_witness w = witness_of(s, best);
    json_t *values = json_array();
    if (!append_numbers(values, best->values, s->parameters)) return json_decref(values), NULL;
    return json_pack("{s:o, s:f, s:f, s:o, s:o, s:b, s:[f,f,f], s:b, s:i}", "values", values, "t",
                     w.t, "length", w.length, "a", side_json(&w.a), "b", side_json(&w.b),
                     "has_normal", w.has_normal, "normal", w.has_normal ? w.normal[0] : 0,
                     w.has_normal ? w.normal[1] : 0, w.has_normal ? w.normal[2] : 0, "at_rest",
                     w.at_rest, "kind", w.kind);
}

static json_t *state_json(const imp_survey *s)
{
    const survey_counts *n = &s->counts;
    const survey_snapshot now = {NULL, n->boxes, n->proved, n->settled, s->best};
    const survey_snapshot *m = s->before.box != NULL ? &s->before : &now;
    return json_pack("{s:o, s:I, s:I, s:f, s:o, s:o, s:o}", "question", question_json(s), "boxes",
                     (json_int_t)(n->boxes_before + m->boxes), "made", (json_int_t)n->made,
                     "proved", m->proved, "settled", number_json(m->settled), "waiting",
                     waiting_json(s), "known", known_json(s, &m->best));
}

char *imp_survey_save(const imp_survey *s, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_save"), NULL;
    const fp_environment environment = fp_environment_enter();
    json_t *state = state_json(s);
    char *text = NULL;
    if (state != NULL)
        text = json_text_of(state, error);
    else
        error_set_memory(error);
    json_decref(state);
    fp_environment_leave(&environment);
    return text;
}

/* --- Reading ---------------------------------------------------------------------------------- */

static double number_of(const json_t *json)
{
    return json_is_number(json) ? json_number_value(json) : INFINITY;
}

/* Reads an index. False: it is not below `count`. */
static bool read_index(const json_t *json, size_t count, size_t *to)
{
    const json_int_t i = json_is_integer(json) ? json_integer_value(json) : -1;
    *to = i >= 0 ? (size_t)i : 0;
    return i >= 0 && (size_t)i < count;
}

static bool read_box(imp_survey *s, const json_t *list, survey_box *box)
{
    const double share = number_of(json_array_get(list, 3));
    size_t number, cost, limit;
    if (json_array_size(list) != BOX_NUMBERS + 2 * s->parameters || !(share >= 0 && share <= 1))
        return false;
    *box = (survey_box){.key = number_of(json_array_get(list, 0)),
                        .share = share,
                        .near = number_of(json_array_get(list, 4))};
    if (!read_index(json_array_get(list, 5), SIZE_MAX, &cost) ||
        !read_index(json_array_get(list, 6), 2 * ROOMY_PAIRS_MOST, &limit) || limit == 0)
        return false;
    box->cost = cost;
    box->limit = limit;
    if (!read_index(json_array_get(list, 1), (size_t)s->counts.made, &number) ||
        !read_index(json_array_get(list, 2), s->pairs.count, &box->pair))
        return false;
    box->number = number;
    if (!(box->key >= (s->question.is_distance ? 0 : s->question.options.t_start))) return false;
    for (size_t j = 0; j < s->parameters; ++j) {
        const double lo = number_of(json_array_get(list, BOX_NUMBERS + 2 * j));
        const double hi = number_of(json_array_get(list, BOX_NUMBERS + 1 + 2 * j));
        if (!(lo >= s->lo[j] && hi <= s->hi[j] && lo <= hi)) return false;
        box->range[2 * j] = lo, box->range[2 * j + 1] = hi;
    }
    return true;
}

/* *good false: the list contradicts the question or itself. */
static imp_code read_waiting(imp_survey *s, const json_t *list, bool *good, imp_error *error)
{
    box_queue_clear(&s->queue);
    *good = json_is_array(list);
    for (size_t k = 0; k < json_array_size(list) && *good; ++k) {
        survey_box *box = malloc(sizeof *box + 2 * s->parameters * sizeof *box->range);
        if (box == NULL) return error_set_memory(error);
        *good = read_box(s, json_array_get(list, k), box);
        if (!*good)
            free(box);
        else if (!box_queue_push(&s->queue, box))
            return error_set_memory(error);
    }
    return IMP_SUCCESS;
}

static bool read_side(const imp_survey *s, const json_t *list, imp_side *side)
{
    if (json_array_size(list) != 8 ||
        !read_index(json_array_get(list, 0), scene_body_count(s->scene), &side->body) ||
        !read_index(json_array_get(list, 1), scene_surface_count(s->scene, side->body),
                    &side->surface) ||
        !read_index(json_array_get(list, 2), SIZE_MAX, &side->piece))
        return false;
    side->u = number_of(json_array_get(list, 3));
    side->v = number_of(json_array_get(list, 4));
    for (size_t i = 0; i < 3; ++i) side->point[i] = number_of(json_array_get(list, 5 + i));
    return side->u < INFINITY && side->v < INFINITY;
}

static void keep_witness(imp_survey *s, const known_witness *w)
{
    survey_incumbent *best = &s->best;
    best->is_known = true;
    if (s->question.is_distance) {
        best->distance = w->length;
        best->nearest = (imp_clearance){.t = w->t, .upper = w->length, .has_witness = true};
        best->nearest.a = w->a, best->nearest.b = w->b;
        best->nearest.has_normal = w->has_normal;
        best->nearest.kind = (imp_contact_kind)w->kind;
        memcpy(best->nearest.normal, w->normal, sizeof w->normal);
    } else {
        best->t = w->t;
        best->contact = (imp_result){.t = w->t, .gap = w->length, .a = w->a, .b = w->b};
        best->contact.has_normal = w->has_normal;
        best->contact.at_rest = w->at_rest;
        best->contact.kind = (imp_contact_kind)w->kind;
        memcpy(best->contact.normal, w->normal, sizeof w->normal);
    }
}

static bool read_known(imp_survey *s, const json_t *known)
{
    const json_t *values = json_object_get(known, "values"), *normal;
    if (json_is_null(known)) return true;
    known_witness w = {.t = number_of(json_object_get(known, "t")),
                       .length = number_of(json_object_get(known, "length")),
                       .has_normal = json_is_true(json_object_get(known, "has_normal")),
                       .at_rest = json_is_true(json_object_get(known, "at_rest"))};
    size_t kind;
    if (!read_index(json_object_get(known, "kind"), IMP_CONTACT_INSIDE + 1, &kind)) return false;
    w.kind = (int)kind;
    normal = json_object_get(known, "normal");
    for (size_t i = 0; i < 3; ++i) w.normal[i] = number_of(json_array_get(normal, i));
    if (!(w.t >= s->question.options.t_start && w.t <= s->question.options.t_end && w.length >= 0 &&
          w.length < INFINITY && json_array_size(values) == s->parameters))
        return false;
    for (size_t j = 0; j < s->parameters; ++j) {
        s->best.values[j] = number_of(json_array_get(values, j));
        if (!(s->best.values[j] >= s->lo[j] && s->best.values[j] <= s->hi[j])) return false;
    }
    if (!read_side(s, json_object_get(known, "a"), &w.a) ||
        !read_side(s, json_object_get(known, "b"), &w.b))
        return false;
    keep_witness(s, &w);
    return true;
}

static imp_code read_state(imp_survey *s, const json_t *state, bool *good, imp_error *error)
{
    const json_t *made = json_object_get(state, "made"), *boxes = json_object_get(state, "boxes");
    s->counts.proved = number_of(json_object_get(state, "proved"));
    s->counts.settled = number_of(json_object_get(state, "settled"));
    *good = json_is_integer(made) && json_integer_value(made) >= (json_int_t)s->counts.made &&
            json_is_integer(boxes) && json_integer_value(boxes) >= 0 && s->counts.settled >= 0 &&
            s->counts.proved >= 0 && s->counts.proved < INFINITY &&
            read_known(s, json_object_get(state, "known"));
    if (!*good) return IMP_SUCCESS;
    s->counts.made = (uint64_t)json_integer_value(made);
    s->counts.boxes_before = (uint64_t)json_integer_value(boxes);
    return read_waiting(s, json_object_get(state, "waiting"), good, error);
}

/* Compares the questions as text: numbers read back as they were written. */
static imp_code check_question(const imp_survey *s, const json_t *state, imp_error *error)
{
    json_t *own = question_json(s), *then = json_object_get(state, "question");
    char *text = own != NULL ? json_text_of(own, error) : NULL;
    char *other = then != NULL ? json_text_of(then, error) : NULL;
    imp_code code = own == NULL || text == NULL ? error_set_memory(error) : IMP_SUCCESS;
    if (code == IMP_SUCCESS && (other == NULL || strcmp(text, other) != 0))
        code = error_set(error, IMP_ERROR_USAGE,
                         "resume: was saved by a survey of another scene, or with other options; "
                         "must be of the same");
    json_decref(own);
    free(text);
    free(other);
    return code;
}

imp_code survey_load(imp_survey *s, const char *text, imp_error *error)
{
    json_t *state = json_loads(text, JSON_REJECT_DUPLICATES, NULL);
    bool good = json_is_object(state);
    imp_code code = good ? check_question(s, state, error) : IMP_SUCCESS;
    if (good && code == IMP_SUCCESS) code = read_state(s, state, &good, error);
    json_decref(state);
    if (code != IMP_SUCCESS || good) return code;
    return error_set(error, IMP_ERROR_USAGE,
                     "resume: got a text that does not tell where a survey stands, must be one "
                     "that imp_survey_save returned");
}
