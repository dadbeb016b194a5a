/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_QUERY_H
#define TOOLS_CLI_QUERY_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/crew.h"

/* From a scene and the command line to an answer. */

/* The registry that --plugin-path, and a build tree we run from, ask for. Warns of directories that
 * should not be trusted; complains and answers NULL when memory runs out. */
imp_registry *query_registry(const arguments *args);

/* Frees it and warns of isolated types whose destroy crashed or did not return. NULL is
 * accepted. */
void query_registry_free(imp_registry *registry);

/* Makes a registry as query_registry does, with `path` (colon-separated directories, may be NULL)
 * in place of --plugin-path, and the flags of imp_registry_open. */
imp_registry *query_registry_first(const char *path, unsigned flags, const char *verb);

/* Checks of the options that concern more than one of them. */
exit_status query_check(const arguments *args);

/* What the scene asks for, overridden by what the command line says. Times that neither names and
 * the scene does not have are NAN, which queries refuse. Of max_seconds what is left now: reading
 * counts. */
imp_options query_options(const imp_scene *scene, const arguments *args);

/* Complains of such times, for verbs that need them before they ask anything. */
exit_status query_check_times(const imp_scene *scene, const imp_options *options,
                              const arguments *args);

/* Runs the query to its end. A signal ends it early: then the result is UNDECIDED, CANCELLED. */
imp_code query_run(imp_query *query, imp_result *result, imp_error *error);

/* Solves the scene under the options given, which override what the scene asks for. A signal ends
 * it early: then the result is UNDECIDED, CANCELLED. */
imp_code query_solve(imp_scene *scene, const arguments *args, imp_result *result, imp_error *error);

/* How many threads --threads asks for; without it, or with 0, as many as there are processors that
 * this process may use. */
size_t query_threads(const arguments *args);

/* How many threads --threads asks for; 1 without it. */
size_t query_threads_asked(const arguments *args);

/* Has a query use the threads of the crew, if it has more than one; the crew must outlive the
 * query. */
void query_lend_threads(imp_options *options, crew *c);

/* The exit status a result stands for. */
exit_status query_status(const imp_result *result, const arguments *args);

/* Prints the result of a query as text or JSON: explained where that is asked for, and an undecided
 * one with advice. */
exit_status query_print(const imp_scene *scene, const imp_query *query, const imp_result *result,
                        const arguments *args);

/* Solves, prints the result as text or JSON, and answers the exit status. Takes over `scene`; where
 * it is NULL, complains of `error`. */
exit_status query_answer(imp_scene *scene, const imp_error *error, const arguments *args);

/* Solves a scene file, prints the result as text or JSON, and answers the exit status. */
exit_status query_answer_file(imp_registry *registry, const char *path, const arguments *args);

/* The scene that the operands name: a file, '-' for standard input, or two pipelines. NULL:
 * *complained tells whether the user knows why already, or `error` does. */
imp_scene *query_scene(imp_registry *registry, const arguments *args, bool *complained,
                       imp_error *error);

/* Says on standard error what types left out of files, or read otherwise than one may expect. NULL:
 * nothing. */
void query_warn(const imp_scene *scene, const arguments *args);

/* What the operands name, as JSON: a string, two, or null for standard input. */
json_t *query_scene_json(const arguments *args);

#endif
