/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_SURVEY_BOXES_H
#define TOOLS_CLI_SURVEY_BOXES_H

#include <jansson.h>

#include "tools/cli/arguments.h"
#include "tools/cli/input.h"
#include "tools/cli/output_file.h"

/* --boxes FILE, --resume FILE: the boxes of a survey, and how another goes on from them
 * ======================================================================================
 * The first line tells which options the run had and of which scene: {"options": ..., "scene":
 * ...}. Each line between is a box. The last line, {"state": ...}, is what imp_survey_save
 * returned. --resume compares the first line with its own, copies the boxes but for those left, and
 * has the survey go on from the last line. FILE is replaced in the end, or stays as it is. */

typedef struct survey_boxes {
    const imp_scene *scene;
    const arguments *args;
    const char *path; /* NULL: none is written */
    output_file out;
    bool begun;      /* `out` is open */
    bool failed;     /* no memory for a line */
    char *state;     /* to go on from; NULL: from the start */
    input_text line; /* being read */
} survey_boxes;

/* Opens the file, where the options ask for one, reads what it goes on from, and sets the sink and
 * `resume` of *how. Complains. Call survey_boxes_end in any case. *boxes must not move. */
exit_status survey_boxes_begin(survey_boxes *boxes, const imp_scene *scene, imp_survey_options *how,
                               const arguments *args);

/* Writes the state and puts the file in its place if `status` is EXIT_ANSWERED; else leaves what
 * was there, and `survey` may be NULL. Returns the status, or that of its own failure. */
exit_status survey_boxes_end(survey_boxes *boxes, const imp_survey *survey, exit_status status);

/* Return {NAME: [lo, hi], ...} and [A, B] (null: all pairs of bodies that no parameter moves).
 * NULL: no memory. */
json_t *survey_ranges_json(const imp_scene *scene, const double *lo, const double *hi);
json_t *survey_bodies_json(const imp_scene *scene, const size_t body[2]);

#endif
