/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_JOB_H
#define TOOLS_CHECK_JOB_H

#include "tools/check/content.h"
#include "tools/check/operand.h"
#include "tools/check/report.h"
#include "tools/check/request.h"

/* The checks of one command
 * =========================
 * A job runs the checks on the plugin that the operand names, reports them, and publishes the
 * verdict. */

/* Choices of --require, in their order. */
enum { REQUIRE_TESTED, REQUIRE_PROVED };

typedef struct job {
    const arguments *args;
    const char *operand;
    operand_type type;
    double seconds;
    double effort;
    uint64_t seed;
    const option_value *formula, *domain; /* or NULL */
    const option_value *only;             /* NULL: all checks */
    bool in_process;
    uint64_t stop_at; /* the call of --call, or 0 */
    check_report report;
    operand_file *file; /* these are shared with children */
    content *content;
    check_answer *answer;
    check_misreading *misreading;
} job;

/* Finds the plugin, and runs and reports the checks. Returns the worst exit status; complains of
 * what is wrong with the command line. */
exit_status job_run(job *j);

#endif
