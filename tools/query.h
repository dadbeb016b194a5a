/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_QUERY_H
#define TOOLS_QUERY_H

#include "arguments.h"

/* From a scene and the command line to an answer. */

/* The registry that --plugin-path, and a build tree we run from, ask for. Warns of directories that
 * should not be trusted; complains and answers NULL when memory runs out. */
imp_registry *query_registry(const arguments *args);

/* The same with `path` (colon-separated directories, may be NULL) in place of --plugin-path, and
 * the flags of imp_registry_open. */
imp_registry *query_registry_first(const char *path, unsigned flags, const char *verb);

/* Checks of the options that concern more than one of them. */
exit_status query_check(const arguments *args);

/* Solves the scene under the options given, which override what the scene asks for. A signal ends
 * it early: then the result is UNDECIDED, CANCELLED. */
imp_code query_solve(imp_scene *scene, const arguments *args, imp_result *result, imp_error *error);

/* The exit status a result stands for. */
exit_status query_status(const imp_result *result, const arguments *args);

/* Solves, prints the result as text or JSON, and answers the exit status. Takes over `scene`; where
 * it is NULL, complains of `error`. */
exit_status query_answer(imp_scene *scene, const imp_error *error, const arguments *args);

/* The same for a scene file. */
exit_status query_answer_file(imp_registry *registry, const char *path, const arguments *args);

#endif
