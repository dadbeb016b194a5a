/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_REPORT_H
#define TOOLS_CHECK_REPORT_H

#include <jansson.h>

#include "tools/check/list.h"
#include "tools/cli/message.h"

/* The report, as text while it is made or as one JSON object at the end (schema in
 * tools/schema/check.schema.json). The object is made in both cases, for badges (badge.h). */

typedef struct check_report {
    bool as_json;
    const char *again; /* a command line that repeats the run, without --only */
    uint64_t seed;
    json_t *root, *types, *type, *checks; /* the last two: what is being filled */
    size_t verdicts[4];                   /* how many of each */
    bool type_failed, type_refuted;
    unsigned type_faults;  /* those reported */
    char type_echoes[400]; /* checks that fail for a reported cause: "errors, proof" */
    uint64_t type_tests;   /* comparisons of bounds */
    check_proof type_proof;
    char spoke[400]; /* checks in which something was written to standard error */
} check_report;

/* One bug can fail many checks. The first failure is reported in full; checks that fail for a
 * possible cause of an earlier failure (answer.h) are only named at the end of the type. */

/* Begins; false if memory runs out. */
bool report_begin(check_report *r, const char *file, double effort);

/* The next results are about this type, no longer about the file. */
void report_type(check_report *r, imp_type_kind kind, const char *name,
                 const char *const stage[CHECK_STAGES]);

void report_add(check_report *r, const char *check, bool of_bounds, const check_answer *answer);

/* The label of the type: `refuted`; `failed` if something else is wrong with it; `proved` if its
 * formula is known and every tested claim follows from it; else `tested`. */
void report_type_end(check_report *r);

/* Prints the totals, or the object, which report->root then is until report_free. */
exit_status report_end(check_report *r, const char *verb);
void report_free(check_report *r);

#endif
