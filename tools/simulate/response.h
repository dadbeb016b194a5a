/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_RESPONSE_H
#define TOOLS_SIMULATE_RESPONSE_H

#include "tools/simulate/impact.h"

/* What bodies do that touch at one instant
 * ========================================
 * a = |gravity| + gamma / (time asked about)^2, L = sqrt(2 gamma a) and V = 2 L: a body thrown up
 * at the speed L rises by gamma. A contact that closes faster than V is an impact; one that closes
 * slower, or whose bodies met LEVEL_LASTING times without parting by more than gamma, is resting.
 *
 * 1. Impacts strike one after another, always the contact that closes fastest, until none closes
 * faster than V: so one impulse travels through a row of balls that touch. Rounds without end, as
 * with e < 1 in a row of bodies, are cut after ROUNDS for each contact.
 * 2. All contacts are settled together, without restitution.
 * 3. Bodies that are then slower than V, and that what they stand on can hold against gravity, come
 * to rest (rest.h): their velocity is 0 from now on, until something moves them. So do those that
 *    were slow SLOW_MAX times in a row.
 * 4. If others are left, 2. is taken back for these: resting contacts open as fast as they closed,
 * but at least at the speed L and at most at 3/2 L, so that bodies slide, roll and tip by hops of
 * one to two gamma. At a level k of the ladder (meeting.h), where earlier hops did not part the
 * bodies, the least speed is L 2^(k/2).
 *
 * No instant gains energy: 1. and 2. by the lemma of impact.h; should 4. gain some, the velocities
 * are made smaller by the factor that brings the energy back to what it was, as rolling resistance
 * would. Where no fixed body is there to take the momentum, resting contacts bounce without loss
 * instead. Driven bodies do work: with them energy may be gained. */

enum { ROUNDS = 64, SLOW_MAX = 256 };

typedef struct contact {
    size_t meeting; /* of which pair of bodies */
    int level;      /* of the ladder, at which they met */
    vec middle;     /* halfway between the nearest points */
    bool resting;   /* not by an impact */
    bool struck;    /* by an impact */
    bool driven;    /* a surface moves beyond the motion of the bodies */
    bool pressed;   /* it carries something when all is settled */
} contact;

/* What is remembered of a body from one instant to the next. */
typedef struct remembered {
    double speed;   /* when all was settled; INFINITY: it was in no contact yet */
    unsigned times; /* in a row that it was slow and did not come to rest */
} remembered;

/* A body in a contact. */
typedef struct participant {
    size_t body; /* of the setup */
    bool moves;
    bool fixed;  /* it has no mass and no motion of its own */
    bool rested; /* it was at rest */
    bool rests;  /* it is now */
    bool joined; /* by a row of contacts to something fixed; for rest_find */
    remembered *memory;
} participant;

/* The bodies and contacts at one instant, as they are changed. Bodies of contacts are numbers in
 * `who` and `bodies`. */
typedef struct instant {
    vec gravity;
    double lift, slow; /* L and V */
    participant *who;
    impact_body *bodies, *spare[3]; /* spare: as many, of no meaning between calls */
    size_t body_count;
    impact_contact *contacts, *kept; /* kept: as many, of no meaning between calls */
    contact *about;                  /* of each contact */
    size_t count;
} instant;

/* Gives impulses to the bodies, and says which rest. */
void response_resolve(instant *now);

/* Returns the kinetic energy of all bodies at the instant. */
double response_energy(const instant *now);

#endif
