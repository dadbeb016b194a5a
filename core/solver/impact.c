/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/solver/impact.h"

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
