/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_EACH_H
#define TOOLS_CLI_EACH_H

#include "tools/cli/arguments.h"
#include "tools/cli/crew.h"
#include "tools/cli/parts.h"
#include "tools/cli/survey_parts.h"

/* solve --each: the first contact of each pair of bodies
 * ======================================================
 * Contacts and undecided pairs come in order of time, then of the bodies in the scene; clear pairs
 * follow in the order of the scene. Bodies that the broad phase separates have the answer of the
 * divided query. Pairs of bodies that were not examined, or not listed, when a limit or a signal
 * came are counted in one last line. Of a scene with parameters each pair of bodies has a survey of
 * its own, and all lines come when all are answered. */

typedef struct printing printing;

typedef struct each {
    const arguments *args;
    const imp_scene *scene;
    crew crew;            /* threads that the query is divided by */
    double until;         /* seconds of the clock: the limit of time; INFINITY: none */
    double until_listed;  /* the end of a list of all pairs */
    parts_plan plan;      /* of surveys only the count */
    survey_parts *survey; /* NULL: there are no parameters */
    imp_result *answers;  /* of the parts; all bytes 0: not there yet */
    char **advice;        /* about undecided ones; NULL: there is none */
    printing *printing;   /* while it lasts */
} each;

/* Divides the scene by so many threads; its parts may then be solved, by as many (parts.h). The
 * struct stays where it is until each_end. Complains of what is wrong. */
exit_status each_begin(each *e, imp_scene *scene, const arguments *args, size_t threads);

/* Prints all answers once those of the parts are known. The exit status is that of the worst. */
exit_status each_print(each *e);

/* Answers part k and keeps its answer. [any thread] */
imp_code each_solve_part(each *e, size_t k, imp_error *error);

void each_end(each *e); /* also after each_begin has failed */

/* Divides, solves and prints; each line is printed as soon as no other can come before it. */
exit_status each_answer(imp_scene *scene, const arguments *args);

#endif
