/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_RUN_OPTIONS_H
#define TOOLS_CLI_RUN_OPTIONS_H

#include <jansson.h>

#include "tools/cli/arguments.h"

/* Which options a run had, so that another goes on from its output only with the same ones. */

/* Returns {"options": {NAME: VALUE, ...}}: those that change results, such as --gamma, as they were
 * written; not limits, threads and the like. NULL: no memory. */
json_t *run_options_json(const arguments *args);

typedef struct run_options_source {
    const char *file;   /* the output */
    const char *record; /* where it is said how that was made */
} run_options_source;

/* Compares the options of an earlier run with the present ones: both are objects of names.
 * Complains of the first that differs, and names the cure. */
exit_status run_options_compare(const run_options_source *of, json_t *then, json_t *now,
                                const arguments *args);

#endif
