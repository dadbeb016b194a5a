/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_SIMULATE_TIMELINE_H
#define TOOLS_SIMULATE_TIMELINE_H

#include "tools/simulate/simulation.h"

/* The course of a simulation: where its bodies are, what they have in sum, and when two meet next.
 */

/* States, and sums of energy and momentum, of all bodies that move. */
void timeline_states(const simulation *s, double t, mover_state *state);
sums timeline_sums(const simulation *s, const mover_state *state);

/* Goes on to t, with what the bodies get from gravity up to then. */
void timeline_advance(simulation *s, double t);

/* Finds the next meeting of two bodies from t on, at level `least` or above. Complains of errors.
 */
exit_status timeline_predict(simulation *s, meeting *m, double t, int least);

/* Predicts the meetings of all pairs from the start. Complains of bodies that are too near to each
 * other there. */
exit_status timeline_predict_all(simulation *s);

/* The earliest that is not NEVER; NULL: there is none up to the end. */
meeting *timeline_earliest(const simulation *s);

/* Goes on with the search of an open meeting. Complains of errors. */
exit_status timeline_continue(simulation *s, meeting *m);

/* The simulation ends here, because of that. `m`: with which bodies; NULL: with none in particular.
 */
void timeline_cut(simulation *s, double t, imp_reason reason, const meeting *m);

/* Complains of a body whose path from now on leaves what can be computed with. */
exit_status timeline_check(const simulation *s, size_t body);

/* Complains of the error of the last search. */
exit_status timeline_complain(const simulation *s);

#endif
