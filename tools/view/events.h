/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_EVENTS_H
#define TOOLS_VIEW_EVENTS_H

#include <jansson.h>
#include <stdbool.h>

#include "tools/cli/vec.h"

/* The "events" that `impinge simulate` wrote into a scene: which bodies touched, when and where. */

typedef struct event {
    double t;
    vec point, normal;
    bool has_normal;
    char what[160]; /* "impact: ball and floor" */
} event;

typedef struct event_list {
    event *event; /* in order of time */
    size_t count;
} event_list;

/* Reads the events of a scene's JSON, which may be NULL; entries that are no events are left out.
 * False: no memory. */
bool events_read(const json_t *scene, event_list *list);
void events_free(event_list *list);

#endif
