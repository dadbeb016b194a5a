/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/survey/survey_proof.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/fp_mode.h"
#include "core/base/status.h"
#include "core/common/array.h"

/* The tree of two surfaces, over the times of a query; bodies are numbered as in the scene. */
typedef struct kept_tree {
    size_t body[2], at[2];
    size_t begin, size; /* its bytes */
} kept_tree;

/* A query of a box. */
typedef struct kept_run {
    double start, end; /* its times; of these, */
    double until;      /* those before this are proved */
    double lower;      /* of a distance */
    uint8_t *bytes;
    size_t size, room;
    kept_tree *trees;
    size_t count, tree_room;
} kept_run;

typedef struct kept_box {
    kept_run *runs;
    size_t count, room;
    size_t along;    /* the parameter along which it is halved */
    uint64_t halves; /* 0: it is not; a first box is no half */
} kept_box;

/* The order of pieces of a surface, as the first query that had one. */
typedef struct kept_order {
    size_t body, at;
    uint32_t *order;
} kept_order;

struct survey_proof {
    kept_box *boxes; /* by number */
    size_t count, room;
    kept_order *orders;
    size_t order_count, order_room;
    uint64_t last;   /* the box whose query was taken last, */
    bool is_pending; /* and nothing was noted of it */
};

/* --- Keeping ---------------------------------------------------------------------------------- */

imp_code imp_survey_keep_proof(imp_survey *s, imp_error *error)
{
    if (s == NULL) return error_set_missing(error, "imp_survey_keep_proof");
    if (s->question.how.resume != NULL)
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: the survey goes on from another, of which it is not known how "
                         "boxes were proved; begin without `resume`");
    if (s->counts.boxes > 0 || s->counts.boxes_before > 0)
        return error_set(error, IMP_ERROR_USAGE, "proof: this survey has been stepped already");
    if (scene_has_solids(s->scene))
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: a body is solid; certificates are about surfaces alone");
    if (s->question.how.body[0] != SIZE_MAX)
        return error_set(error, IMP_ERROR_USAGE,
                         "proof: got a survey of two bodies, must be one of all");
    if (s->proof == NULL) s->proof = calloc(1, sizeof *s->proof);
    if (s->proof == NULL) return error_set_memory(error);
    /* A certificate bounds each point at all values of a box: no maps are held. */
    const fp_environment environment = fp_environment_enter();
    const imp_code code = survey_choose_swept(s, error);
    fp_environment_leave(&environment);
    return code;
}

static kept_box *box_of(survey_proof *p, uint64_t number)
{
    while (p->count <= number) {
        kept_box *grown = array_reserve(p->boxes, p->count, &p->room, sizeof *grown);
        if (grown == NULL) return NULL;
        p->boxes = grown;
        grown[p->count++] = (kept_box){.runs = NULL};
    }
    return &p->boxes[number];
}

static kept_run *add_run(survey_proof *p, uint64_t number)
{
    kept_box *box = box_of(p, number);
    if (box == NULL) return NULL;
    kept_run *grown = array_reserve(box->runs, box->count, &box->room, sizeof *grown);
    if (grown == NULL) return NULL;
    box->runs = grown;
    grown[box->count] = (kept_run){.until = -INFINITY, .lower = -INFINITY};
    p->last = number;
    p->is_pending = true;
    return &grown[box->count++];
}

/* A run to which bytes are added. */
typedef struct filling {
    kept_run *run;
    bool failed;
} filling;

static void add_bytes(void *context, const void *bytes, size_t size)
{
    filling *f = context;
    for (size_t k = 0; k < size && !f->failed; ++k) {
        uint8_t *grown = array_reserve(f->run->bytes, f->run->size, &f->run->room, sizeof *grown);
        f->failed = grown == NULL;
        if (f->failed) return;
        f->run->bytes = grown;
        grown[f->run->size++] = ((const uint8_t *)bytes)[k];
    }
}

static kept_order *find_order(const survey_proof *p, size_t body, size_t at)
{
    for (size_t k = 0; k < p->order_count; ++k)
        if (p->orders[k].body == body && p->orders[k].at == at) return &p->orders[k];
    return NULL;
}

static bool keep_order(survey_proof *p, size_t body, const candidate *c)
{
    const uint32_t *order = proof_order(c);
    if (order == NULL || find_order(p, body, c->surface) != NULL) return true;
    kept_order *grown = array_reserve(p->orders, p->order_count, &p->order_room, sizeof *grown);
    if (grown == NULL) return false;
    p->orders = grown;
    const size_t bytes = surface_piece_count(tree_root(c->tree)->surface) * sizeof *order;
    kept_order made = {body, c->surface, malloc(bytes)};
    if (made.order == NULL) return false;
    memcpy(made.order, order, bytes);
    grown[p->order_count++] = made;
    return true;
}

static bool keep_tree(survey_proof *p, const survey_pair *pair, const proof_search *search,
                      const proof_trees *trees, size_t index, kept_run *run)
{
    const candidate_pair *both = &search->list->pairs[index];
    filling f = {.run = run};
    const proof_sink to = {add_bytes, &f};
    kept_tree *grown = array_reserve(run->trees, run->count, &run->tree_room, sizeof *grown);
    if (grown == NULL) return false;
    run->trees = grown;
    kept_tree *made = &grown[run->count++];
    *made = (kept_tree){.begin = run->size};
    for (int side = 0; side < 2; ++side) {
        const candidate *c = both->side[side];
        made->body[side] = box_is_unmoved(pair) ? c->body : pair->body[c->body];
        made->at[side] = c->surface;
        if (!keep_order(p, made->body[side], c)) return false;
    }
    proof_search_write(search, trees, index, run->start, run->end, &to);
    made->size = run->size - made->begin;
    return !f.failed;
}

imp_code survey_proof_take(imp_survey *s, const survey_box *box, const imp_query *query,
                           query_times times, imp_error *error)
{
    if (s->proof == NULL) return IMP_SUCCESS;
    const proof_search search = query_proof_search(query);
    proof_trees *trees = search.log->failed ? NULL : proof_trees_new(search.log);
    kept_run *run = trees != NULL ? add_run(s->proof, box->number) : NULL;
    bool kept = run != NULL;
    if (kept) run->start = times.start, run->end = times.end;
    for (size_t k = 0; k < search.list->pair_count && kept; ++k)
        kept = keep_tree(s->proof, &s->pairs.at[box->pair], &search, trees, k, run);
    proof_trees_free(trees);
    return kept ? IMP_SUCCESS : error_set_memory(error);
}

void survey_proof_note(imp_survey *s, double t, double lower)
{
    if (s->proof == NULL || !s->proof->is_pending) return;
    s->proof->is_pending = false;
    const kept_box *box = &s->proof->boxes[s->proof->last];
    box->runs[box->count - 1].until = t;
    box->runs[box->count - 1].lower = lower;
}

imp_code survey_proof_halve(imp_survey *s, const survey_box *box, size_t along, uint64_t halves,
                            imp_error *error)
{
    if (s->proof == NULL) return IMP_SUCCESS;
    kept_box *kept = box_of(s->proof, box->number);
    if (kept == NULL) return error_set_memory(error);
    kept->along = along;
    kept->halves = halves;
    return IMP_SUCCESS;
}

void survey_proof_free(survey_proof *p)
{
    if (p == NULL) return;
    for (size_t k = 0; k < p->count; ++k) {
        for (size_t i = 0; i < p->boxes[k].count; ++i) {
            free(p->boxes[k].runs[i].bytes);
            free(p->boxes[k].runs[i].trees);
        }
        free(p->boxes[k].runs);
    }
    for (size_t k = 0; k < p->order_count; ++k) free(p->orders[k].order);
    free(p->boxes);
    free(p->orders);
    free(p);
}

/* --- Writing ---------------------------------------------------------------------------------- */

/* What is written: the trees of two surfaces. */
typedef struct writer {
    const imp_survey *s;
    const proof_claim *claim;
    const size_t *body, *at;
    const survey_pair *pair;
    const proof_sink *to;
} writer;

static void put_run(const writer *w, const kept_run *run, double lo, double hi)
{
    for (size_t k = 0; run != NULL && k < run->count; ++k) {
        const kept_tree *t = &run->trees[k];
        if (t->body[0] != w->body[0] || t->body[1] != w->body[1] || t->at[0] != w->at[0] ||
            t->at[1] != w->at[1])
            continue;
        proof_tree_copy(run->bytes + t->begin, t->size, run->start, run->end, lo, hi, w->to);
        return;
    }
    w->to->write(w->to->context, &(uint8_t){PROOF_OP_ALONE}, 1);
}

static void put_box(const writer *w, uint64_t number, double lo, double hi);

static const kept_box *find_box(const writer *w, uint64_t number)
{
    static const kept_box none;
    const survey_proof *p = w->s->proof;
    return number < p->count ? &p->boxes[number] : &none;
}

/* Halves are divided where the search divided them: in the middle of what was left of a range. */
static void put_halves(const writer *w, const kept_box *box, double lo, double hi)
{
    const bool is_swept = box->along == w->pair->swept;
    const uint8_t op = is_swept ? PROOF_OP_TIME : PROOF_OP_CLOCK, half[2] = {0x80, 0};
    w->to->write(w->to->context, &op, 1);
    if (!is_swept) proof_put_count(w->to, box->along + 1);
    w->to->write(w->to->context, half, sizeof half);
    const double mid = proof_place(lo, hi, 0x8000);
    put_box(w, box->halves, lo, is_swept ? mid : hi);
    put_box(w, box->halves + 1, is_swept ? mid : lo, hi);
}

static void put_rest(const writer *w, const kept_box *box, double lo, double hi)
{
    if (box->halves > 0)
        put_halves(w, box, lo, hi);
    else
        put_run(w, box->count > 0 ? &box->runs[box->count - 1] : NULL, lo, hi);
}

/* Writes, of a distance, the query that proved the claim, or halves. */
static void put_distance(const writer *w, const kept_box *box, double lo, double hi)
{
    const kept_run *last = box->count > 0 ? &box->runs[box->count - 1] : NULL;
    if (last != NULL && last->lower >= w->claim->apart)
        put_run(w, last, lo, hi);
    else
        put_rest(w, box, lo, hi);
}

/* Writes a box over the T from lo to hi: what each of its queries has proved, one after the other,
 * and its halves. */
static void put_box(const writer *w, uint64_t number, double lo, double hi)
{
    const kept_box *box = find_box(w, number);
    if (w->s->question.is_distance) return put_distance(w, box, lo, hi);
    for (size_t k = 0; k < box->count; ++k) {
        const kept_run *run = &box->runs[k];
        if (run->until >= hi) return put_run(w, run, lo, hi);
        const double k16 = floor((run->until - lo) / (hi - lo) * 65536);
        if (!(k16 >= 1)) continue;
        const uint8_t bytes[] = {PROOF_OP_TIME, (uint8_t)((unsigned)k16 >> 8), (uint8_t)k16};
        const double split = proof_place(lo, hi, (unsigned)k16);
        w->to->write(w->to->context, bytes, sizeof bytes);
        put_run(w, run, lo, split);
        lo = split;
    }
    put_rest(w, box, lo, hi);
}

/* Returns the pair of these bodies, or that of all that no parameter moves. Its first box has the
 * number of the pair. */
static size_t pair_of(const imp_survey *s, const size_t body[2])
{
    size_t k = 0;
    while (k + 1 < s->pairs.count &&
           !(s->pairs.at[k].body[0] == body[0] && s->pairs.at[k].body[1] == body[1]))
        ++k;
    return k;
}

static void put_pair(void *context, const size_t body[2], const size_t at[2], const proof_sink *to)
{
    writer w = *(const writer *)context;
    const imp_survey *s = w.s;
    const size_t number = pair_of(s, body);
    const surface *of[2];
    for (int side = 0; side < 2; ++side) of[side] = scene_surface(s->scene, body[side], at[side]);
    w.body = body, w.at = at, w.to = to, w.pair = &s->pairs.at[number];
    const bool is_swept = box_is_swept(w.pair);
    proof_put_count(to, surface_common_motion(of[0], of[1]));
    proof_put_count(to, is_swept ? w.pair->swept + 1 : 0);
    for (int side = 0; side < 2; ++side) {
        const size_t pieces = surface_piece_count(of[side]);
        const kept_order *kept = find_order(s->proof, body[side], at[side]);
        if (pieces > 1) proof_put_order(to, kept != NULL ? kept->order : NULL, pieces);
    }
    if (!(w.claim->apart > 0)) { /* nothing is to be proved */
        to->write(to->context, &(uint8_t){PROOF_OP_ALONE}, 1);
        return;
    }
    put_box(&w, number, is_swept ? s->lo[w.pair->swept] : w.claim->from,
            is_swept ? s->hi[w.pair->swept] : w.claim->to);
}

imp_code survey_proof_write(const imp_survey *s, const proof_claim *claim, const char *stated,
                            const proof_sink *to, imp_error *error)
{
    writer w = {.s = s, .claim = claim};
    const proof_source trees = {&w, put_pair};
    return proof_file_write(s->scene, &trees, claim, stated, to, error);
}
