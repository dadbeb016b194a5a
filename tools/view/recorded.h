/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_RECORDED_H
#define TOOLS_VIEW_RECORDED_H

#include <jansson.h>

#include "tools/cli/message.h"
#include "tools/view/stage.h"

/* A result that `solve --json`, `pair --json` or `clearance --json` printed, read back. It names
 * its scene: the file, or the two surfaces. */

typedef enum recorded_kind {
    RECORDED_NOTHING, /* it is taken for a scene, and the rest is empty */
    RECORDED_RESULT,
    RECORDED_CLEARANCE
} recorded_kind;

typedef struct recorded {
    recorded_kind kind;
    const json_t *json;          /* the caller's, */
    const char *scene, *pair[2]; /* and one of them: the JSON's */
} recorded;

/* Finds out which kind of result the JSON is, which may be NULL. Complains of a result that names
 * no scene. */
exit_status recorded_read(const json_t *json, const char *name, const char *verb, recorded *r);

/* Sets the times of the answer, if it has them. */
void recorded_times(const recorded *r, imp_options *options);

/* Returns the answer, with the scene's bodies; the spot is known if the answer has two points. */
exit_status recorded_answer(const recorded *r, const imp_scene *scene, const imp_options *options,
                            const char *name, const char *verb, stage_contact *contact,
                            stage_spot *spot);

/* Three numbers. */
bool recorded_vector(const json_t *array, vec *v);

#endif
