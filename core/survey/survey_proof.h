/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SURVEY_SURVEY_PROOF_H
#define CORE_SURVEY_SURVEY_PROOF_H

#include "core/solver/query_proof.h"
#include "core/survey/box_question.h"

/* What a survey keeps for a certificate
 * =====================================
 * Boxes of values form a tree by their numbers: the halves of a box have two numbers in a row. Each
 * box keeps what its queries have proved, a tree for each pair of surfaces, as bytes that are put
 * into the cells of the certificate's tree when that is written (proof_tree_copy). What queries
 * prove at the middle of a box only says where the verifier should look: it proves each leaf over
 * all values of its own. */

/* Keeps the trees of a query of the box that has ended, over its times. What it has proved counts
 * as soon as it is known: survey_proof_note. */
imp_code survey_proof_take(imp_survey *s, const survey_box *box, const imp_query *query,
                           query_times times, imp_error *error);

/* Notes, once, that the query taken last has proved its box until t, a time of queries; or, of
 * distances, that its bodies are `lower` apart. */
void survey_proof_note(imp_survey *s, double t, double lower);

/* Notes that a box is halved along a parameter; `halves` is the number of the lower half. */
imp_code survey_proof_halve(imp_survey *s, const survey_box *box, size_t along, uint64_t halves,
                            imp_error *error);

/* Writes the trees of the claim. */
imp_code survey_proof_write(const imp_survey *s, const proof_claim *claim, const char *stated,
                            const proof_sink *to, imp_error *error);

void survey_proof_free(survey_proof *proof); /* may be NULL */

#endif
