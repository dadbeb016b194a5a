/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_REST_H
#define TOOLS_SIMULATE_REST_H

#include "tools/simulate/response.h"

/* Which bodies come to rest
 * =========================
 * Those that are slower than V, not faster than when they last touched something (by more than
 * YIELDING V: else something pushes them; nor faster than that alone if they were struck just now),
 * and that stay where they are when gravity pulls at them: it gives each a
 * velocity of the size V, the contacts among them and with fixed bodies answer by the plastic
 * law of impact.h, and nothing is left of it but RESIDUE V. Bodies that do not stay are left
 * out, then those that stood on them, until nothing changes. Each must stand on something fixed, if
 * only through others. */

#define RESIDUE 1e-3
#define YIELDING 0.02

/* `settled`: the bodies after all contacts are settled. Says of each body whether it rests. Uses
 * now->spare[2] and now->kept. */
void rest_find(instant *now, const impact_body *settled);

/* Returns the velocity V along gravity, that it gives what falls freely; 0 without gravity. */
vec rest_pull(const instant *now);

/* Returns the speed of a body at its fastest point of contact, or of its centre. */
double rest_speed(const instant *now, const impact_body *bodies, size_t body);

#endif
