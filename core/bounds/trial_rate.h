/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_TRIAL_RATE_H
#define CORE_BOUNDS_TRIAL_RATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How often a trial paid
 * ========================
 * A step that costs much and helps in few scenes is tried at each chance as long as it pays, else
 * now and then. Each search counts for each candidate pair, in the order of its steps: the search
 * is the same in every run, and other bodies do not matter. This decides how long a search takes,
 * never what it proves. */

typedef struct trial_rate {
    uint16_t left;        /* chances left out since the last one taken */
    uint16_t taken, paid; /* among the last TRIALS_KEPT taken, about */
} trial_rate;             /* begins as {0} */

enum { TRIALS_KEPT = 1024 };

/* Whether to take this chance: one in `share` of those taken paid, or `wait` were left out, or c is
 * NULL. */
static inline bool trial_rate_take(trial_rate *c, unsigned share, unsigned wait)
{
    if (c == NULL) return true;
    if (share * c->paid < c->taken && c->left < wait) {
        c->left += 1;
        return false;
    }
    c->left = 0;
    if (c->taken == TRIALS_KEPT) {
        c->taken /= 2;
        c->paid /= 2;
    }
    c->taken += 1;
    return true;
}

/* Notes whether the chance taken last paid. */
static inline void trial_rate_note(trial_rate *c, bool pays)
{
    if (c != NULL) c->paid += pays;
}

#endif
