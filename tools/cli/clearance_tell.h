/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CLEARANCE_TELL_H
#define TOOLS_CLI_CLEARANCE_TELL_H

#include "tools/cli/arguments.h"
#include "tools/cli/clearance.h"
#include "tools/cli/explain.h"

/* Results of `impinge clearance`, and their output: each slice is printed as soon as it is known,
 * everything else at the end. */

typedef struct measuring {
    const arguments *args;
    const imp_scene *scene;
    imp_query *query;
    imp_options options;
    imp_clearance_options asked;
    bool json, each, profile;
    double until;    /* seconds of the clock: the limit of time; INFINITY: none */
    double printing; /* seconds that slices have taken to print */
    clearance_table table;
    size_t beyond, not_examined; /* pairs of bodies of --each */
    explanation why;             /* of one search that is undecided; else empty */
    imp_stats stats;
} measuring;

/* Prints the slice that is the last of the table, with --profile. */
exit_status clearance_tell_slice(const measuring *m);

/* Returns the summary without any answer: with --each, if all pairs are ignored. */
imp_clearance clearance_of_nothing(const measuring *m);

/* Prints the answers. `shown` is the table, or the table with one more answer, for pairs that are
 * not listed. */
exit_status clearance_conclude(const measuring *m, const clearance_table *shown);

#endif
