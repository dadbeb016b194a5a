/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BOUNDS_TRIAL_RATE_H
#define CORE_BOUNDS_TRIAL_RATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How often an expensive step is tried
 * ====================================
 * A step that costs much and helps in few scenes is tried at every opportunity while it pays, else
 * now and then. Each search keeps one count per candidate pair, in the order of its steps, so that
 * the search is the same in every run and independent of other bodies. The count decides how long a
 * search takes, never what it proves. */

typedef struct trial_rate {
    uint16_t left;        /* opportunities skipped since the last trial */
    uint16_t taken, paid; /* among the last TRIALS_KEPT trials, about */
} trial_rate;             /* begins as {0} */

enum { TRIALS_KEPT = 1024 };

/* Whether to try now: one in `share` of the trials paid, or `wait` opportunities were skipped since
 * the last, or c is NULL. */
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

/* Notes whether the last trial paid. */
static inline void trial_rate_note(trial_rate *c, bool pays)
{
    if (c != NULL) c->paid += pays;
}

#endif
