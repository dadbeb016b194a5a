/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_LIST_H
#define TOOLS_CHECK_LIST_H

#include <impinge/impinge.h>

#include "tools/check/answer.h"
#include "tools/check/fate.h"

/* The list of checks
 * ==================
 * Some concern a file, some each type in it, once for each of a few stages ("sphere radius=2").
 * Each is run in a child process of its own. */

enum { CHECK_STAGES = 2 };

typedef struct check_task {
    const char *file; /* absolute path of the plugin */
    imp_type_kind kind;
    const char *type;                /* NULL: the file itself */
    const char *stage[CHECK_STAGES]; /* of that type, NULL-terminated if fewer */
    const char *formula;             /* "X; Y; Z" the stated formula, or NULL */
    const char *domain;              /* "0,1; 0,1" the stated domain, or NULL */
    const char *search;              /* directories of --plugin-path, or NULL */
    uint64_t seed;
    double effort;    /* 1: as usual */
    size_t check;     /* index */
    bool in_process;  /* run it in this process, which ends where the plugin crashes */
    uint64_t stop_at; /* tell a debugger before this call into the plugin; 0: never */
} check_task;

/* Names of the checks, in the order they are run, NULL-terminated. */
extern const char *const check_names[];

/* What the check with that index tests. */
bool check_is_of_file(size_t check);

/* Returns whether it tries to refute bounds, so that its comparisons count for the type's label. */
bool check_is_of_bounds(size_t check);

/* Runs it in a child process with that time limit in seconds, or in this one. *shared is from
 * child_memory. */
child_fate check_run(const check_task *task, double seconds, check_answer *shared);

#endif
