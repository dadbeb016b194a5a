/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_IMPACT_H
#define TOOLS_SIMULATE_IMPACT_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/simulate/rigid.h"

/* Impulses between rigid bodies
 * =============================
 * A contact of two bodies is a manifold: up to CONTACT_POINTS points with a common normal n. Each
 * gets an impulse J on the second body, -J on the first. With u the velocity of the second body
 * against the first at a point, before (-) and after (+), all impulses of one solution obey
 *
 *   Signorini   J.n >= 0,  u+.n >= target,  and one of both is an equality
 *   Coulomb     |J_t| <= mu J.n;  where it slides afterwards, J_t is opposed to u+_t and as large
 *
 * They are found point after point (Gauss-Seidel), each point by itself exactly.
 *
 * Restitution. With target 0 (the plastic solution P) no energy is gained: the change of the
 * kinetic energy is sum J.(u- + u+) / 2, each J.u+ <= 0, and sum J.(u+ - u-) = J'KJ >= 0. With
 * Newton's targets -e u-.n (the solution N) it may be, as Kane and Levinson have shown, if there is
 * friction. Lemma: every P + s (N - P), 0 <= s <= 1, is within the cones of friction and parts the
 * bodies, since cones are convex and u+ is linear in the impulses. So the impulse taken is that
 * with the greatest s whose energy is not above
 *
 *   max(energy of P, min(energy before, energy of N without friction)),
 *
 * which is at most the energy before. Without friction, or where friction takes energy, s is 1. */

enum { CONTACT_POINTS = 8 };

typedef struct impact_body {
    bool yields; /* else it moves as it does, whatever the impulse */
    double mass;
    mat3 inverse;                 /* of the inertia about the centre, in the world's axes */
    vec position;                 /* of the centre */
    vec velocity, momentum, spin; /* momentum: angular, about the centre; spin = inverse momentum */
} impact_body;

typedef struct impact_point {
    vec at;
    vec drift;     /* velocity of the second surface against the first beyond that of the bodies */
    vec impulse;   /* on the second body, in sum */
    double target; /* of u+.n, for impact_solve */
    struct solving {
        vec before, change; /* u-, and the impulse so far */
        mat3 axes;          /* rows: the normal and two tangents */
        mat3 k, inverse;    /* in these axes: u+ = u- + k J */
    } solving;              /* by the solver, for itself */
} impact_point;

typedef struct impact_contact {
    size_t body[2];
    vec normal; /* unit, from the first to the second */
    double restitution, friction;
    size_t count; /* from 1 to CONTACT_POINTS */
    impact_point point[CONTACT_POINTS];
} impact_contact;

/* Returns the velocity of the second body against the first at a point. */
vec impact_velocity(const impact_body *bodies, const impact_contact *c, size_t point);

/* Returns how fast a contact closes at its fastest point; negative: it opens. */
double impact_closing(const impact_body *bodies, const impact_contact *c);

/* The kinetic energy of a body that yields, else 0. */
double impact_energy(const impact_body *b);

/* Gives `impulse` at a point to b and the opposite to a, to each if it yields. */
void impact_exchange(impact_body *a, impact_body *b, vec at, vec impulse);

/* Solves for all contacts together with the targets of their points, and moves the bodies on.
 * False: it found no solution, which may happen with much friction; then bodies and impulses are of
 * no use. *gain: the energy gained, as seen from where the surfaces drift to; without drift it is
 * the change of the bodies' kinetic energy. */
bool impact_solve(impact_body *bodies, impact_contact *contacts, size_t count, bool friction,
                  double *gain);

/* Adds the impulses of the last solution to those in sum. */
void impact_keep(impact_contact *contacts, size_t count);

/* One contact strikes, by the law above, with this restitution. */
void impact_strike(impact_body *bodies, impact_contact *c, double restitution);

#endif
