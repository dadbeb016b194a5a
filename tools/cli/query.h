/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_QUERY_H
#define TOOLS_CLI_QUERY_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/crew.h"

/* Solves scenes with the options of the command line. */

/* Makes the registry of --plugin-path and, if the command runs from one, the build tree. Warns of
 * directories that should not be trusted. NULL: no memory; it complains. */
imp_registry *query_registry(const arguments *args);

/* Frees it and warns of isolated types whose destroy crashed or did not return. `registry` may be
 * NULL. */
void query_registry_free(imp_registry *registry);

/* Makes a registry as query_registry does, with `path` (colon-separated directories, may be NULL)
 * in place of --plugin-path, and the flags of imp_registry_open. */
imp_registry *query_registry_first(const char *path, unsigned flags, const char *verb);

/* Checks of the options that concern more than one of them. */
exit_status query_check(const arguments *args);

/* Returns the scene's options, overridden by those of the command line. Times that neither has are
 * NAN, which queries refuse. max_seconds is reduced by the time of reading. */
imp_options query_options(const imp_scene *scene, const arguments *args);

/* Complains if times are NAN, for verbs that need them before a query. */
exit_status query_check_times(const imp_scene *scene, const imp_options *options,
                              const arguments *args);

/* Runs the query to its end. A signal ends it early: then the result is UNDECIDED, CANCELLED. */
imp_code query_run(imp_query *query, imp_result *result, imp_error *error);

/* Solves the scene with these options, which override the scene's. A signal ends it early: then the
 * result is UNDECIDED, CANCELLED. *advice is set to query_advice; `advice` may be NULL. */
imp_code query_solve(imp_scene *scene, const arguments *args, imp_result *result, char **advice,
                     imp_error *error);

/* Returns a sentence of advice about an undecided query for contact, which the caller frees; NULL:
 * there is none, or no memory. [any thread] */
char *query_advice(const imp_scene *scene, const imp_query *query);

/* Returns the number of --threads; without it, or with 0, the number of processors that this
 * process may use. */
size_t query_threads(const arguments *args);

/* Returns the number of --threads; 1 without it. */
size_t query_threads_asked(const arguments *args);

/* Has a query use the threads of the crew, if it has more than one; the crew must outlive the
 * query. */
void query_lend_threads(imp_options *options, crew *c);

/* Returns the exit status for a result. */
exit_status query_status(const imp_result *result, const arguments *args);

/* Prints the result of a query as text or JSON: with --explain explained, and with advice if
 * undecided. */
exit_status query_print(const imp_scene *scene, const imp_query *query, const imp_result *result,
                        const arguments *args);

/* Solves a scene, prints the result as text or JSON, and returns the exit status. Takes ownership
 * of `scene`; if it is NULL, complains of `error`. */
exit_status query_answer(imp_scene *scene, const imp_error *error, const arguments *args);

/* Solves a scene file, prints the result as text or JSON, and returns the exit status. */
exit_status query_answer_file(imp_registry *registry, const char *path, const arguments *args);

/* Reads the scene that the operands name: a file, '-' for standard input, or two pipelines. NULL:
 * an error; *complained is false if it is in `error` and not reported yet. */
imp_scene *query_scene(imp_registry *registry, const arguments *args, bool *complained,
                       imp_error *error);

/* Warns on standard error about parts of files that types left out or reinterpreted. `scene` may be
 * NULL. */
void query_warn(const imp_scene *scene, const arguments *args);

/* Returns the operands as JSON: a string, two, or null for standard input. */
json_t *query_scene_json(const arguments *args);

#endif
