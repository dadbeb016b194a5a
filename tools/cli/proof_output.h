/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROOF_OUTPUT_H
#define TOOLS_CLI_PROOF_OUTPUT_H

#include "tools/cli/arguments.h"

/* Certificates, written where --proof says */

extern const option options_proof[];

/* Complains if --proof is given beside --each, --refine or --profile, and says what to ask
 * instead. */
exit_status proof_output_check(const arguments *args);

/* Has the query keep a proof if --proof asks for one. */
exit_status proof_output_begin(imp_query *query, const arguments *args);

/* Like proof_output_begin, of a survey. */
exit_status proof_output_begin_survey(imp_survey *survey, const arguments *args);

/* Writes the proof of a survey that has ended, if --proof asks for one. */
exit_status proof_output_write_survey(const imp_survey *survey, const imp_scene *scene,
                                      const arguments *args);

/* Writes the proof of a query that has ended, if --proof asks for one. EXIT_ANSWERED also where
 * nothing was proved: that is remarked, and no file is written. */
exit_status proof_output_write(const imp_query *query, const imp_scene *scene,
                               const arguments *args);

#endif
