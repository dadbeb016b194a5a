/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_EVENT_H
#define TOOLS_SIMULATE_EVENT_H

#include "tools/simulate/simulation.h"

/* Handles one event: all contacts at t, and of the bodies that touch those that collide, the
 * response to them, the new paths, and the meetings on these. Where a budget or a signal leaves
 * open what touches, the simulation ends at t, before the event. Complains of errors. */
exit_status event_handle(simulation *s, double t);

#endif
