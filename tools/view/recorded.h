/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_RECORDED_H
#define TOOLS_VIEW_RECORDED_H

#include <jansson.h>

#include "tools/cli/message.h"
#include "tools/view/stage.h"

/* A result that `solve --json` or `pair --json` printed, read back. It names its scene: the file, or
 * the two surfaces. */

typedef struct recorded {
    bool is_result; /* else it is taken for a scene, and the rest is empty */
    json_t *json;
    const char *scene, *pair[2]; /* one of them; the json's */
} recorded;

/* What the text is. Complains of a result that names no scene; of text that is no JSON the reader
 * of scenes complains. */
exit_status recorded_read(const char *text, size_t length, const char *name, const char *verb,
                          recorded *r);
void recorded_free(recorded *r);

/* Sets the times that the answer is about, if it tells them. */
void recorded_times(const recorded *r, imp_options *options);

/* The answer, in terms of the scene. */
exit_status recorded_contact(const recorded *r, const imp_scene *scene, const char *name,
                             const char *verb, stage_contact *contact);

#endif
