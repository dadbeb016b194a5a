/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_RECORD_H
#define TOOLS_SIMULATE_RECORD_H

#include "tools/simulate/simulation.h"

/* What a simulation leaves. */

/* Writes the scene whose maps reproduce the motion, with its events, written whole or not at all.
 * */
exit_status record_write(const simulation *s, const char *path);

/* Where it ended, energy and momentum, for people. */
void record_print(const simulation *s, const char *path);

/* Returns what record_print prints, as tools/schema/simulate.schema.json describes it. NULL: no
 * memory. */
json_t *record_json(const simulation *s, const char *path);

#endif
