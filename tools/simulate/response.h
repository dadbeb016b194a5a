/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_RESPONSE_H
#define TOOLS_SIMULATE_RESPONSE_H

#include "tools/simulate/touch.h"

/* Impulses at one instant
 * =======================
 * All contacts of one instant are resolved together, one impulse after another: always the contact
 * that closes fastest, until none closes (sequential impulses; through a row of equal balls that
 * touch, one impulse travels to its end). Restitution is Newton's: the normal speed is turned round
 * and multiplied by e. Friction is Coulomb's: the impulse that stops sliding, if it lies in the
 * cone of friction, else mu times the normal impulse against the sliding. Should the two laws
 * together raise the energy, which they can, the impulse is taken without friction.
 *
 * Rounds without end, as with e < 1 in a row of touching bodies, are cut: after ROUNDS for
 * each contact restitution counts as 0.
 *
 * Lasting contacts. A contact lasts if it closes slower than V = 2 L with L^2 = 8 gamma a, a =
 * |gravity| + gamma / (time asked about)^2, or if the two met LEVEL_LASTING times without parting
 * by more than gamma. It has no restitution, and is left opening at the speed L, which carries a
 * body no farther than 4 gamma against gravity: so bodies slide and roll, by small hops. A body
 * which is slow (its centre, and its spin times the arm, below V) after SLOW_MAX lasting contacts
 * in a row with bodies that are fixed or rest, comes to rest: it is held until something hits it
 * faster than V. */

enum { ROUNDS = 64, SLOW_MAX = 8 };

typedef struct contact {
    size_t body[2];
    touching at;
    double restitution, friction;
    bool lasting;
    vec impulse; /* on the second body, in sum */
} contact;

/* The bodies at one instant, as they are changed. */
typedef struct instant {
    const setup *setup;
    mover *movers;      /* by body */
    mover_state *state; /* by body; of those that move */
    bool *changed;      /* by body */
    bool *rests;        /* by body: held, or comes to rest now */
    vec to_fixed;       /* impulses on what does not move, in sum */
    double lift, slow;  /* L and V */
} instant;

/* How fast a contact opens along its normal, negative: closes. */
double contact_speed(const instant *now, const contact *c);

/* Applies impulses to the state. */
void response_resolve(instant *now, contact *contacts, size_t count);

#endif
