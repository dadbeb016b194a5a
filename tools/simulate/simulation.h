/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_SIMULATION_H
#define TOOLS_SIMULATE_SIMULATION_H

#include "tools/simulate/meeting.h"
#include "tools/simulate/response.h"

/* From event to event
 * ===================
 * Each pair of bodies of which one moves have a meeting: the next contact, found once and kept
 * until one of the two changes its path. The earliest of all is the next event. Its time, and all
 * before it, is covered by the proofs of all meetings. */

typedef struct sums {
    double energy;         /* kinetic and potential, of the bodies that move */
    vec momentum, angular; /* angular: about the origin */
} sums;

typedef struct simulation {
    const setup *setup;
    searching search;
    mover *movers;      /* by body */
    remembered *memory; /* by body */
    double lift;        /* L of response.h */
    meeting *meetings;
    size_t meeting_count;
    bool *rests, *held_now; /* by body; the latter at the last event */
    size_t max_events, events, impacts, held;
    double t;           /* how far it came */
    const char *reason; /* why it ended before the end; NULL: it did not */
    char hint[320];     /* what helps against that; "": nothing in particular */
    json_t *log;        /* the events */
    sums start, end;
    double energy_lost; /* in events, in sum */
    vec from_fixed;     /* momentum that what does not move has given */
    vec from_gravity;
} simulation;

/* Runs to the end, or until a budget or a signal ends it. Complains of errors. Call simulation_free
 * in any case. */
exit_status simulation_run(simulation *s, const setup *what, const arguments *args);
void simulation_free(simulation *s);

/* Returns the greatest error of sub-steps, radians. */
double simulation_substep_error(const simulation *s);

#endif
