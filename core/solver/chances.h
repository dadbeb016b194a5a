/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SOLVER_CHANCES_H
#define CORE_SOLVER_CHANCES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* How often something paid
 * ========================
 * A step that costs much and helps in few scenes is tried at each chance as long as it pays, else
 * now and then. Each search counts for each candidate pair, in the order of its steps: the search
 * is the same in every run, and other bodies do not matter. This decides how long a search takes,
 * never what it proves. */

typedef struct chances {
    uint16_t left;        /* chances left out since the last one taken */
    uint16_t taken, paid; /* among the last CHANCES_KEPT taken, about */
} chances;                /* begins as {0} */

enum { CHANCES_KEPT = 1024 };

/* Whether to take this chance: one in `share` of those taken paid, or `wait` were left out, or c is
 * NULL. */
static inline bool chances_take(chances *c, unsigned share, unsigned wait)
{
    if (c == NULL) return true;
    if (share * c->paid < c->taken && c->left < wait) {
        c->left += 1;
        return false;
    }
    c->left = 0;
    if (c->taken == CHANCES_KEPT) {
        c->taken /= 2;
        c->paid /= 2;
    }
    c->taken += 1;
    return true;
}

/* Notes whether the chance taken last paid. */
static inline void chances_note(chances *c, bool pays)
{
    if (c != NULL) c->paid += pays;
}

#endif
