/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURVEY_BOX_QUESTION_H
#define CORE_SURVEY_BOX_QUESTION_H

#include "core/survey/survey_internal.h"

/* How one box of parameter values is decided (survey_ask): box_query.c asks the ordinary query at
 * the middle of the box, box_contact.c and box_distance.c draw the conclusions for the earliest
 * contact and for the least distance, survey_box.c has what both share. */

/* What is left of a box after its queries. */
typedef enum box_state {
    BOX_OPEN,   /* to be halved */
    BOX_DONE,   /* nothing, or nothing that could change the answer */
    BOX_WAITING /* all of it: a limit ended the query, or doubles cannot resolve more */
} box_state;

/* The times of the queries of a box: what is left of the parameter that is swept, or of time. */
typedef struct query_times {
    double start, end;
} query_times;

/* Whether the pair stands for the rest of the pairs of bodies, which no parameter moves. */
bool box_is_unmoved(const survey_pair *pair);

/* Whether queries of the pair take a parameter for their time. */
bool box_is_swept(const survey_pair *pair);

query_times box_times(const imp_survey *s, const survey_box *box);

/* Makes the scene of the box's bodies at its middle; free it by imp_scene_free. */
imp_code box_scene(imp_survey *s, const survey_box *box, imp_scene **made, imp_error *error);

/* Runs a query on that scene. gamma: {gamma, gamma_clear}; pairs: a limit of this query's own, 0:
 * none; spread may be NULL. `proved`: the box of which the query's proof is kept, if the survey
 * keeps any; NULL: none. */
imp_code box_run_contact(imp_survey *s, const survey_box *proved, imp_scene *scene,
                         query_times times, const double gamma[2], uint64_t pairs,
                         const query_spread *spread, imp_result *result, imp_error *error);

/* Pairs of a query with room. It takes no more than its box's limit, then the box is halved: where
 * room nearly fills the gap, pairs become small before they are excluded, and halves take a tenth
 * of them. The links of real arms take the fewest pairs with first limits of 500 to 2000; with 4000
 * they take twice as many. Meshes that turn all around each other take thousands of pairs at any
 * gap, however small the box: halves that a limit has made have twice that limit. */
enum { ROOMY_PAIRS_LEAST = 1000, ROOMY_PAIRS_MOST = 64000 };

/* Raises the limit of a box, for its halves. */
void box_raise_limit(survey_box *box);

/* Runs a query with room for the shift of two bodies, and the box's limit: `coarse` is {gamma,
 * gamma_clear} with room. Pairs are also excluded by the directions in which the values move the
 * bodies (pair_spread.h), with the tolerances `exact`, which have no room. */
imp_code box_run_roomy(imp_survey *s, const survey_box *box, imp_scene *scene,
                       const box_bounds *bounds, query_times times, const double coarse[2],
                       const double exact[2], imp_result *result, imp_error *error);

/* Whether such a limit ends a query before the survey's own would. */
bool box_limits_first(const imp_survey *s, uint64_t pairs);

imp_code box_run_distance(imp_survey *s, const survey_box *proved, imp_scene *scene,
                          query_times times, double within, double tolerance, imp_clearance *answer,
                          imp_error *error);

bool box_is_limit(imp_reason reason);

/* Records the reason if it is a limit, which ends the survey's step; that also answers a request to
 * cancel. */
bool box_must_end(imp_survey *s, imp_reason reason);

/* Measures the box over the times in question: for a contact, those that are left. */
imp_code box_measure(imp_survey *s, const survey_box *box, box_bounds *bounds, imp_error *error);

/* Queues the halves of the box, which share the middle. *done false: it cannot be halved. */
imp_code box_split(imp_survey *s, const survey_box *box, const box_bounds *bounds, bool *done,
                   imp_error *error);

/* Replaces indices of bodies in a box's scene by those in the survey's scene. */
void box_name_side(const survey_pair *pair, imp_side *a, imp_side *b);

/* Stores the values at which a witness of the pair was found, and converts *t from a time of its
 * query to the scene's time. */
void box_keep_values(imp_survey *s, const survey_pair *pair, const double *values, double *t);

/* Asks about a box; *state is BOX_OPEN at the call. */
imp_code box_ask_contact(imp_survey *s, survey_box *box, box_state *state, imp_error *error);
imp_code box_ask_distance(imp_survey *s, survey_box *box, box_state *state, imp_error *error);

#endif
