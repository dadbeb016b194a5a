/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_MOVER_H
#define TOOLS_SIMULATE_MOVER_H

#include "tools/simulate/setup.h"
#include "tools/simulate/values.h"

/* A rigid body between impacts
 * ============================
 * Its centre of mass follows a parabola. Its angular momentum is constant. Where the angular
 * velocity is along it (a principal axis, or equal moments of inertia), the spin is constant too;
 * otherwise the body turns in sub-steps of constant spin: orientations at their ends come from a
 * Runge-Kutta method with steps an eighth as long, and between them the spin is that which leads
 * from one to the next. So the orientation shown differs from the computed one within sub-steps
 * only, by about |d spin / dt| h^2 / 8; the largest such angle is the sub-step error. */

/* Rounding of an angle grows with it: at more radians in one path the keys of a trajectory no
 * longer agree with its spins. */
#define TURN_MAX 1e8

/* From t on, until the next key: a parabola and a constant spin. */
typedef struct mover_key {
    double t;
    vec position, velocity, acceleration; /* of the centre */
    quat rotation;                        /* from the axes at the start */
    vec spin;
} mover_key;

typedef struct mover_state {
    vec position, velocity;
    quat rotation;
    vec momentum; /* angular, about the centre */
    vec spin;     /* = (inertia in the world's axes)^-1 momentum */
} mover_state;

typedef struct mover_keys {
    mover_key *key;
    size_t count, capacity;
} mover_keys;

typedef struct mover {
    const actor *actor;
    vec acceleration;     /* now */
    vec momentum;         /* angular, now */
    mat3 inverse;         /* of the inertia, in the axes of the start */
    mover_keys done;      /* the past */
    mover_keys path;      /* from now on; the last key is the end */
    json_t *map;          /* of the path: parameters of a trajectory */
    double substep_error; /* radians, so far */
} mover;

/* At the start. Only actors that move have a mover. Returns false when memory runs out, as all
 * here. */
bool mover_begin(mover *m, const actor *a, vec gravity, double start, double end);
void mover_free(mover *m);

/* The time at which a key of the path from now on leaves what can be computed with: places,
 * velocities and momenta up to VALUE_MAX, a turn of the path's spin by TURN_MAX. NAN: there is
 * none. */
double mover_overflow(const mover *m);

/* At a time from now to the end. */
mover_state mover_at(const mover *m, double t);

/* Ends the path at t and begins another with that state. */
bool mover_turn(mover *m, double t, const mover_state *state, vec acceleration, double end);

/* Returns the rotation R of the body: its surfaces stand at world = position + R (x - center of the
 * start). */
mat3 mover_axes(const mover_state *s);
/* Returns the inverse of the inertia in the world's axes. */
mat3 mover_inverse_inertia(const mover *m, const mover_state *s);

/* Sets the spin that belongs to the momentum. */
void mover_spin_update(const mover *m, mover_state *s);

double mover_kinetic_energy(const mover *m, const mover_state *s);

/* Returns the whole motion up to t, as a map. NULL: no memory. */
json_t *mover_trajectory(const mover *m, double t);

#endif
