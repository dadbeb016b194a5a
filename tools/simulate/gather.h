/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_GATHER_H
#define TOOLS_SIMULATE_GATHER_H

#include "tools/simulate/simulation.h"
#include "tools/simulate/touch.h"

/* All contacts at one time: those that are due, those of what touches their bodies, and so on. */

typedef struct gathered_contact {
    size_t meeting;
    int level; /* of the ladder, at which the two met */
    touching at;
} gathered_contact;

typedef struct gathered {
    double t;
    gathered_contact *contact;
    size_t count, capacity;
    imp_reason cut; /* why not all contacts are known; NONE: they are */
} gathered;

/* Meetings as late as that count as at time t: some roundings later. */
double gather_limit(const simulation *s, double t);

/* Complains of errors. Call gather_free in any case. */
exit_status gather_all(simulation *s, double t, gathered *g);
void gather_free(gathered *g);

/* Returns whether a meeting has a contact in it. */
bool gather_has(const gathered *g, size_t index);

#endif
