/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_REPORT_H
#define TOOLS_CHECK_REPORT_H

#include <jansson.h>

#include "check_list.h"
#include "message.h"

/* The report, as text while it is made or as one JSON object at the end (schema in
 * tools/schema/check.schema.json). */

typedef struct check_report {
    bool as_json;
    const char *again; /* a command line that does it all again, without --only */
    uint64_t seed;
    json_t *root, *types, *type, *checks; /* the last two: what is being filled */
    size_t passed, failed, skipped;
    bool type_failed, type_refuted;
    uint64_t type_tests; /* comparisons of bounds */
    check_proof type_proof;
} check_report;

/* Begins; false if memory runs out. */
bool report_begin(check_report *r, const char *file, double effort);

/* What follows is about this type, no longer about the file. */
void report_type(check_report *r, imp_type_sort sort, const char *name,
                 const char *const stage[CHECK_STAGES]);

void report_add(check_report *r, const char *check, bool of_bounds, const check_answer *answer);

/* The label of the type: `refuted`; `failed` where something else is wrong with it; `proved` if
 * its formula is known and every claim that was asked for follows from it; else `tested`. */
void report_type_end(check_report *r);

/* Totals; prints the object. */
exit_status report_end(check_report *r, const char *verb);

#endif
