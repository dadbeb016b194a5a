/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_CARRIED_H
#define TOOLS_SIMULATE_CARRIED_H

#include "tools/simulate/setup.h"

/* Bodies with a mass that their own maps move
 * ===========================================
 * The laws of impact move a body with a mass; its own maps place it, and may change its shape with
 * time. Maps that move it as a rigid body would give it a velocity and a spin that no momentum or
 * energy counts: they are refused. */

/* Complains if points of a body that varies keep their distances while they move. Nothing is said
 * of maps that change the shape, too. */
exit_status carried_check(const setup *s, size_t body);

#endif
