/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <math.h>
#include <stdint.h>

#include "core/common/capabilities.h"
#include "tools/check/subject.h"

/* How a subject is made: its pieces, and the domain in which it is examined. */

/* Names a call without numbers, and keeps what is special about it. */
static void name_call(check_answer *answer, const char *name)
{
    subject_note_call(answer, name, answer->call.hint);
}

static void cut_times(double *lo, double *hi)
{
    const bool from = *lo > -INFINITY, to = *hi < INFINITY;
    if (!from && !to)
        *lo = -1, *hi = 3;
    else if (!from)
        *lo = *hi - 4;
    else if (!to)
        *hi = *lo + 4;
}

/* Times around the span of a map that is defined at all times, some of them before and after it;
 * false, and the check fails, if it is invalid. */
static bool take_span(subject *s, double *lo, double *hi)
{
    const imp_map_type *map = s->instance->map;
    double span[2] = {-INFINITY, INFINITY};
    if (!map_type_offers(map, CAPABILITY_SPAN)) return true;
    s->answer->call = (check_call){.name = "span"};
    map->span(s->instance->self, &span[0], &span[1]);
    s->answer->call.name = NULL;
    if (!(span[0] <= span[1]))
        return answer_fail_for(s->answer, FAULT_DOMAIN, "the span is empty or NaN: [%g, %g]",
                               span[0], span[1]);
    const double margin = (span[1] - span[0]) / 4;
    if (!(margin < INFINITY)) return true;
    if (*lo == -INFINITY) *lo = span[0] - margin;
    if (*hi == INFINITY) *hi = span[1] + margin;
    return true;
}

static bool judge_domain(const subject *s)
{
    const box *d = &s->domain;
    for (int j = 0; j < s->n; ++j)
        if (!(d->lo[j] <= d->hi[j] && d->lo[j] > -INFINITY && d->hi[j] < INFINITY))
            return answer_fail_for(s->answer, FAULT_DOMAIN, "the domain is empty or infinite: %s",
                                   subject_box_text(s->n, d->lo, d->hi).text);
    return true;
}

size_t subject_piece_count(const imp_instance *instance, check_answer *answer)
{
    if (!surface_type_offers(instance->surface, CAPABILITY_PIECES)) return 0;
    name_call(answer, "piece_count");
    const size_t count = instance->surface->piece_count(instance->self);
    answer->call.name = NULL;
    return count;
}

/* Returns the k-th piece of an instance, or itself. Pieces are only ever asked, which changes
 * nothing. */
static const imp_instance *piece_of(const imp_instance *instance, size_t k, imp_instance *piece,
                                    check_answer *answer)
{
    if (k >= subject_piece_count(instance, answer)) return instance;
    name_call(answer, "piece");
    const void *self = instance->surface->piece(instance->self, k);
    answer->call.name = NULL;
    *piece = (imp_instance){instance->surface, NULL, (void *)(uintptr_t)self};
    return self != NULL ? piece : NULL;
}

bool subject_make(subject *s, const imp_instance *instance, const imp_instance *twin, size_t k,
                  check_answer *answer)
{
    *s = (subject){.answer = answer};
    s->instance = piece_of(instance, k, &s->one, answer);
    s->twin = piece_of(twin, k, &s->other, answer);
    if (s->instance == NULL || s->twin == NULL)
        return answer_fail_for(answer, FAULT_DOMAIN, "piece gives NULL for number %zu", k);
    instance = s->instance;
    s->n = instance->surface != NULL ? 3 : 4;
    const int t = s->n - 1;
    for (int j = 0; j < 3; ++j) s->domain.lo[j] = -2, s->domain.hi[j] = 2;
    name_call(answer, "domain");
    if (instance->surface != NULL)
        instance->surface->domain(instance->self, s->domain.lo, s->domain.hi);
    else
        instance->map->time_domain(instance->self, &s->domain.lo[t], &s->domain.hi[t]);
    answer->call.name = NULL;
    s->ends[0] = s->domain.lo[t];
    s->ends[1] = s->domain.hi[t];
    if (!take_span(s, &s->domain.lo[t], &s->domain.hi[t])) return false;
    cut_times(&s->domain.lo[t], &s->domain.hi[t]);
    return judge_domain(s);
}
