/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_LIMITS_H
#define TOOLS_SIMULATE_LIMITS_H

#include <impinge/impinge.h>

/* What ends a simulation before its end
 * =====================================
 * A signal, and the limits that the user sets for all searches together. The clock starts when the
 * scene is read. */

typedef struct limits {
    double deadline;    /* of clock_seconds; INFINITY: none */
    uint64_t max_pairs; /* 0: no limit */
    uint64_t pairs;     /* spent */
} limits;

limits limits_begin(double max_seconds, uint64_t max_pairs);

/* Keeps these seconds, or all that are left, for what comes after the motion. */
void limits_reserve(limits *l, double seconds);

/* Whether a signal has come or the time is up: NONE, CANCELLED or SECONDS. */
imp_reason limits_reached(const limits *l);

/* Hands to one search what is left of the limits. */
void limits_apply(const limits *l, imp_options *options);

#endif
