/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/impact.h"

#include <string.h>

#include "core/solver/pair_note.h"
#include "core/solver/pair_step.h"

static void push(impact *im, pair *p)
{
    p->key[0] = p->window.lo;
    p->divided = 0;
    pair_push(&im->heap, p, p->window.lo, &im->serial, im->stats);
}

void impact_push(impact *im, pair_test *t)
{
    im->stats->pairs += 1;
    im->stats->bytes += t->bytes;
    if (im->explained != NULL) im->explained[t->p.candidate_pair].tested += 1;
    pair_note_test(im->proof, &t->p, t->near);
    if (t->near) push(im, &t->p);
}

void impact_push_untested(impact *im, const pair *p)
{
    pair waiting = *p;
    waiting.is_seen_only = waiting.lacks_nets = true;
    pair_note_test(im->proof, &waiting, true);
    push(im, &waiting);
}

/* --- Further candidates ----------------------------------------------------------------------- */

/* Lengthens an array, if there is one; what is new is 0. False: no memory. */
static bool lengthen(arena_store *store, void **array, size_t old, size_t count, size_t size)
{
    if (*array == NULL) return true;
    char *longer = arena_store_regrow(store, *array, old * size, count * size);
    if (longer == NULL) return false;
    memset(longer + old * size, 0, (count - old) * size);
    *array = longer;
    return true;
}

bool impact_take_candidates(impact *im, candidate_pair *pairs, size_t count)
{
    const size_t old = im->candidate_pair_count;
    void *trials = im->trials, *roots = im->roots, *passed = im->passed, *explained = im->explained;
    im->candidate_pairs = pairs;
    if (count == old) return true;
    arena_store *store = im->heap.store;
    const bool ok = lengthen(store, &trials, old, count, sizeof *im->trials) &&
                    lengthen(store, &roots, old, count, sizeof *im->roots) &&
                    lengthen(store, &passed, old, count, sizeof *im->passed) &&
                    lengthen(store, &explained, old, count, sizeof *im->explained);
    if (ok && trials != NULL) im->stats->bytes += (count - old) * sizeof *im->trials;
    im->trials = trials, im->roots = roots, im->passed = passed, im->explained = explained;
    for (size_t k = old; ok && roots != NULL && k < count; ++k)
        im->roots[k] = (time_window){NAN, NAN};
    if (ok) im->candidate_pair_count = count;
    return ok;
}

void impact_note_gap(impact *im, const witness *seen)
{
    if (im->any_gap && !(seen->gap < im->least_gap)) return;
    im->any_gap = true;
    im->least_gap = seen->gap;
}

impact_state impact_contact(impact *im, const witness *seen)
{
    im->found = *seen;
    return IMPACT_CONTACT;
}
