/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/check/pieces.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/capabilities.h"
#include "tools/check/calls.h"

typedef struct visit {
    const imp_instance *whole;
    size_t count;
    const void **pieces; /* as they were first answered */
    check_answer *answer;
} visit;

static bool take(visit *v, size_t k)
{
    subject s;
    if (!subject_make(&s, v->whole, v->whole, k, v->answer)) return false;
    v->pieces[k] = s.instance->self;
    double x[3], error[3], first[3], times[2][3];
    for (int j = 0; j < 3; ++j) first[j] = s.domain.lo[j];
    s.instance->surface->domain(v->pieces[0], times[0], times[1]);
    const double lo = times[0][2], hi = times[1][2];
    s.instance->surface->domain(v->pieces[k], times[0], times[1]);
    if (times[0][2] != lo || times[1][2] != hi)
        return answer_fail_for(v->answer, FAULT_DOMAIN,
                               "piece %zu exists for t in [%g, %g], piece 0 for [%g, %g]", k,
                               times[0][2], times[1][2], lo, hi);
    return subject_eval_sane(&s, 1, first, x, error);
}

/* Returns whether piece k is what it was. */
static bool is_kept(const visit *v, size_t k)
{
    v->answer->tests += 1;
    subject_note_call(v->answer, "piece", NULL);
    const bool kept = v->whole->surface->piece(v->whole->self, k) == v->pieces[k];
    v->answer->call.name = NULL;
    return kept || answer_fail(v->answer,
                               "piece(self, %zu) gave another pointer than before: each piece is "
                               "one instance, the same each time",
                               k);
}

static bool is_count_kept(const visit *v)
{
    const size_t now = subject_piece_count(v->whole, v->answer);
    v->answer->tests += 1;
    return now == v->count ||
           answer_fail(v->answer, "piece_count was %zu, and then %zu", v->count, now);
}

/* Calls of every callback of one piece; they may not change which pieces there are. */
static bool use(const visit *v, uint64_t *random)
{
    subject s;
    if (!subject_make(&s, v->whole, v->whole, draw_index(random, v->count), v->answer))
        return false;
    for (size_t which = 0; which < PURE_CALLS; ++which) pure_call(&s, which, random);
    return true;
}

enum { ASKED_AGAIN = 2000 };

/* First all, in order, then some, in any order and between other calls. */
static bool visit_all(visit *v)
{
    uint64_t random = draw_stream(1, "pieces", "");
    for (size_t k = 0; k < v->count; ++k)
        if (!take(v, k)) return false;
    for (size_t k = 0; k < v->count; ++k)
        if (!is_kept(v, k)) return false;
    for (int k = 0; k < ASKED_AGAIN; ++k)
        if (!is_kept(v, draw_index(&random, v->count)) || !is_count_kept(v) || !use(v, &random))
            return false;
    return true;
}

void pieces_check(imp_registry *registry, const imp_type_info *type, const char *stage,
                  check_answer *answer)
{
    imp_instance made;
    imp_error error;
    if (subject_create(registry, type->kind, stage, &made, &error, answer) != IMP_SUCCESS) {
        answer_fail(answer, "'%.300s' does not work: %s", stage, error.text);
        return;
    }
    visit v = {.whole = &made, .count = subject_piece_count(&made, answer), .answer = answer};
    const bool has = surface_type_offers(made.surface, CAPABILITY_PIECES);
    if (has && (v.count == 0 || v.count > IMP_PIECES_MAX))
        answer_fail(answer, "piece_count is %zu, must be from 1 to %zu", v.count, IMP_PIECES_MAX);
    else if (has) {
        v.pieces = malloc(v.count * sizeof *v.pieces);
        if (v.pieces != NULL) visit_all(&v);
    } else
        answer_skip(answer, "the type has no pieces");
    free(v.pieces);
    subject_destroy(&made, stage, answer);
}
