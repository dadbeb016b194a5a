/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_BENCH_SCENES_H
#define TOOLS_BENCH_SCENES_H

#include "tools/bench/bench.h"

/* Scenes that the sets ask about
 * ==============================
 * Each function adds its scenes to the last case begun. Scenes with a closed form have a
 * reference. */

enum { BENCH_DIRECTIONS = 20, BENCH_TORI = 3 };

/* Two unit spheres whose centres are 2 + gap apart along n. */
void bench_add_gap(bench_cases *list, double gap, const double n[3]);

/* Two bodies with two spikes each. The first of each point at each other; their tips, 2 from the
 * centres, meet at t = 0.5. */
void bench_add_head_on(bench_cases *list, double width);

/* A's spike sweeps through longitude at latitude 0.3 and hits the flank of B's, whose axis crosses
 * its own at t = 0.5. */
void bench_add_swing(bench_cases *list, double width);

/* Two tori that turn and drift, k < BENCH_TORI, and the name of their motion. */
void bench_add_tori(bench_cases *list, int k);
const char *bench_tori_name(int k);

/* BENCH_DIRECTIONS scenes of a sphere that flies at another, from random directions. */
void bench_add_flights(bench_cases *list);

/* A fixture and an arm of three links, each turning about the end of the one before. */
void bench_add_arm(bench_cases *list, uint64_t *state);

#endif
