/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_ACTOR_H
#define TOOLS_SIMULATE_ACTOR_H

#include "tools/simulate/setup.h"

/* Reads what the scene's text says of one body into s->actors, and integrates what it does not say.
 * Complains. */
exit_status actor_read(setup *s, size_t body);

/* Removes the keys that only a simulation has from a body. */
void actor_strip(json_t *body);

#endif
