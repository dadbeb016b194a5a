/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"
#include "core/common/clock.h"
#include "tools/cli/clearance.h"
#include "tools/cli/explain.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/parts.h"

typedef struct filling {
    const clearance_each *of;
    clearance_answers *found; /* in any order; changed with the lock held */
    size_t capacity;          /* of its list, */
    size_t advice_capacity;   /* and of its advice */
    pthread_mutex_t lock;
    atomic_size_t bytes;      /* of the answers that are there */
    _Atomic imp_reason ended; /* why parts were left out; NONE: none was */
} filling;

void clearance_add_stats(imp_stats *all, const imp_stats *s)
{
    all->seconds += s->seconds;
    all->pairs += s->pairs;
    all->nodes += s->nodes;
    all->witness_searches += s->witness_searches;
    if (s->peak_heap > all->peak_heap) all->peak_heap = s->peak_heap;
    if (s->bytes > all->bytes) all->bytes = s->bytes;
}

/* Adds an answer to the list; false: no memory. */
static bool add(filling *f, const imp_clearance *answer)
{
    clearance_answers *found = f->found;
    imp_clearance *grown = array_reserve(found->list, found->count, &f->capacity, sizeof *grown);
    if (grown == NULL) return false;
    found->list = grown;
    found->list[found->count++] = *answer;
    return true;
}

/* Adds advice about the bodies of an answer, and takes over its text. Without memory for it there
 * is no advice. */
static void add_advice(filling *f, const imp_clearance *answer, char *text)
{
    clearance_answers *found = f->found;
    clearance_advice *grown =
        array_reserve(found->advice, found->advice_count, &f->advice_capacity, sizeof *grown);
    if (grown == NULL) {
        free(text);
        return;
    }
    found->advice = grown;
    found->advice[found->advice_count++] =
        (clearance_advice){{answer->body[0], answer->body[1]}, text};
    atomic_fetch_add(&f->bytes, sizeof *grown + strlen(text) + 1);
}

static void take(void *context, size_t index, imp_query *part)
{
    filling *f = context;
    imp_clearance answer = {.struct_size = (uint32_t)sizeof answer};
    (void)index;
    imp_clearance_get(part, 0, &answer, NULL);
    const bool is_beyond = f->of->within > 0 && answer.lower >= f->of->within;
    const explain_asked asked = explain_asked_of_clearance(f->of->scene, &answer);
    char *advice =
        clearance_is_undecided(&answer) && !is_beyond ? explain_advice(part, &asked) : NULL;
    pthread_mutex_lock(&f->lock);
    if (advice != NULL) add_advice(f, &answer, advice);
    clearance_add_stats(&f->found->stats, &answer.stats);
    if (is_beyond)
        f->found->beyond += 1;
    else if (add(f, &answer))
        atomic_fetch_add(&f->bytes, sizeof answer);
    else
        atomic_store(&f->ended, IMP_REASON_MEMORY);
    pthread_mutex_unlock(&f->lock);
}

/* Whether memory is over the limit. Answers count, too: all are kept until they are sorted and
 * printed. */
static bool is_over(void *context)
{
    filling *f = context;
    const clearance_each *of = f->of;
    imp_reason reason = IMP_REASON_NONE;
    const uint64_t whole = of->max_bytes > 0 ? imp_query_result(of->query).stats.bytes : 0;
    if (of->max_bytes > 0 && whole + atomic_load(&f->bytes) > of->max_bytes)
        reason = IMP_REASON_MEMORY;
    if (clock_seconds() >= of->until) reason = IMP_REASON_SECONDS;
    if (interrupt_came()) reason = IMP_REASON_CANCELLED;
    if (reason == IMP_REASON_NONE) return atomic_load(&f->ended) != IMP_REASON_NONE;
    atomic_store(&f->ended, reason);
    return true;
}

/* Returns the answer for two bodies that never exist together; or for bodies beyond `within`, if
 * `reason` is DECIDED; or for bodies not examined when another reason ended the search. */
static imp_clearance answer_of_none(const clearance_each *of, imp_reason reason, size_t a, size_t b)
{
    const imp_result whole = imp_query_result(of->query);
    const bool is_beyond = reason == IMP_REASON_DECIDED;
    const bool ended = reason != IMP_REASON_NO_TIME && !is_beyond;
    return (imp_clearance){.struct_size = (uint32_t)sizeof(imp_clearance),
                           .reason = reason,
                           .verdict = !(of->required > 0) ? IMP_REQUIREMENT_NONE
                                      : ended             ? IMP_REQUIREMENT_UNDECIDED
                                                          : IMP_REQUIREMENT_HOLDS,
                           .t_start = whole.t_start,
                           .t_end = whole.t_end,
                           .body = {a, b},
                           .lower = ended       ? 0
                                    : is_beyond ? of->within
                                                : INFINITY,
                           .upper = INFINITY,
                           .t = NAN,
                           .required = of->required,
                           .t_violated = NAN};
}

/* Adds the pairs of bodies that are never both there, which have no part, until a limit comes. */
static bool add_absent(filling *f, size_t parts)
{
    enum { PAIRS_A_LOOK = 1024 };
    const clearance_each *of = f->of;
    const size_t bodies = imp_scene_body_count(of->scene);
    size_t part = 0, looked = 0, absent = imp_scene_pair_count(of->scene) - parts, body[2];
    for (size_t a = 0; a < bodies && absent > 0; ++a)
        for (size_t b = a + 1; b < bodies; ++b) {
            if (looked++ % PAIRS_A_LOOK == 0 && is_over(f)) return true;
            if (imp_scene_ignores(of->scene, a, b)) continue;
            const bool is_part =
                imp_query_part_bodies(of->query, part, body) && body[0] == a && body[1] == b;
            const imp_clearance none = answer_of_none(of, IMP_REASON_NO_TIME, a, b);
            part += is_part;
            if (is_part) continue;
            absent -= 1;
            if (!add(f, &none)) return false;
            atomic_fetch_add(&f->bytes, sizeof none);
        }
    return true;
}

/* Counts the pairs of bodies that are not listed; one answer is added for them if it has
 * information that the others lack. */
static bool count_rest(filling *f, size_t parts, imp_reason ended)
{
    clearance_answers *found = f->found;
    const size_t pairs = imp_scene_pair_count(f->of->scene);
    const bool is_divided = imp_query_result(f->of->query).verdict != IMP_VERDICT_UNDECIDED;
    if (f->of->within > 0 && is_divided) found->beyond += pairs - parts;
    found->not_examined = pairs - found->count - found->beyond;
    found->has_rest = found->not_examined > 0 || (found->count == 0 && found->beyond > 0);
    if (!found->has_rest) return true;
    const imp_reason reason = found->not_examined > 0 ? ended : IMP_REASON_DECIDED;
    const imp_clearance rest = answer_of_none(f->of, reason, SIZE_MAX, SIZE_MAX);
    if (!add(f, &rest)) return false;
    found->count -= 1;
    return true;
}

/* Finishes the list once no more parts are measured. */
static imp_code conclude(filling *f, size_t parts)
{
    const imp_result whole = imp_query_result(f->of->query);
    const bool divided = whole.verdict != IMP_VERDICT_UNDECIDED;
    if (divided && atomic_load(&f->ended) == IMP_REASON_NONE && !(f->of->within > 0) &&
        !add_absent(f, parts))
        return IMP_ERROR_MEMORY;
    const imp_reason ended = divided ? atomic_load(&f->ended) : whole.reason;
    if (ended == IMP_REASON_NONE && !(f->of->within > 0)) return IMP_SUCCESS;
    return count_rest(f, parts, ended) ? IMP_SUCCESS : IMP_ERROR_MEMORY;
}

static int by_bodies(const void *x, const void *y)
{
    const clearance_advice *a = x, *b = y;
    const int side = a->body[0] != b->body[0] ? 0 : 1;
    return a->body[side] < b->body[side] ? -1 : a->body[side] > b->body[side];
}

const char *clearance_table_advice(const clearance_table *table, const imp_clearance *answer)
{
    const clearance_advice key = {{answer->body[0], answer->body[1]}, NULL};
    if (table->advice_count == 0) return NULL;
    const clearance_advice *found =
        bsearch(&key, table->advice, table->advice_count, sizeof key, by_bodies);
    return found != NULL ? found->text : NULL;
}

void clearance_answers_free(clearance_answers *found)
{
    for (size_t k = 0; k < found->advice_count; ++k) free(found->advice[k].text);
    free(found->advice);
    free(found->list);
    *found = (clearance_answers){.list = NULL};
}

imp_code clearance_each_run(const clearance_each *of, clearance_answers *found, imp_error *error)
{
    filling f = {
        .of = of, .found = found, .lock = PTHREAD_MUTEX_INITIALIZER, .ended = IMP_REASON_NONE};
    parts_plan plan = {.whole = of->query,
                       .threads = of->threads,
                       .take = take,
                       .is_over = is_over,
                       .context = &f};
    *found = (clearance_answers){.list = NULL};
    imp_code code = imp_query_divide(of->query, &plan.count, error);
    if (code != IMP_SUCCESS) return code;
    code = parts_run(&plan, error);
    const imp_stats whole = imp_query_result(of->query).stats;
    clearance_add_stats(&found->stats, &whole);
    if (code == IMP_SUCCESS) code = error->code = conclude(&f, plan.count);
    if (found->advice_count > 0)
        qsort(found->advice, found->advice_count, sizeof *found->advice, by_bodies);
    return code;
}
