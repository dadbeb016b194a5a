/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_PAIR_NOTE_H
#define CORE_SOLVER_PAIR_NOTE_H

#include "core/proof/proof_log.h"
#include "core/solver/subdivision.h"

/* What the searches note of a pair where a proof is kept
 * ======================================================
 * p->proof is the last record of the pair, or of its parent until the first test, and p->step how
 * the next record follows from that. Without a log (NULL) nothing happens. */

/* Notes a test, which left p->window or, where not `near`, nothing. */
static inline void pair_note_test(proof_log *log, pair *p, bool near)
{
    if (log == NULL) return;
    p->proof = proof_log_add(log, p->step, p->proof, p->axis.x, near ? p->window.lo : 1,
                             near ? p->window.hi : 0);
    p->step = PROOF_AGAIN;
}

/* Notes what distances have left of the window `before`, if that is less. */
static inline void pair_note_look(proof_log *log, pair *p, time_window before)
{
    if (log == NULL || (p->window.lo == before.lo && p->window.hi == before.hi)) return;
    pair_note_test(log, p, true);
}

/* Notes that the pair stands for the part p->window of a window. */
static inline void pair_note_span(proof_log *log, pair *p)
{
    if (log == NULL) return;
    p->step = PROOF_SPAN;
    pair_note_test(log, p, true);
}

/* Notes the half that has taken the place of a node, ahead of its test. */
static inline void pair_note_cut(proof_log *log, pair *p, const cut *c, int half)
{
    if (log == NULL) return;
    if (c->along == PARAMETER_T)
        pair_note_span(log, p);
    else
        p->step = (uint8_t)proof_half(c->side, c->along == PARAMETER_V, half);
}

#endif
