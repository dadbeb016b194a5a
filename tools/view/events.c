/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/view/events.h"

#include <stdio.h>
#include <stdlib.h>

#include "tools/view/recorded.h"

/* A body's name, or that of the body a side belongs to. */
static const char *body_of(const json_t *side)
{
    const char *name = json_string_value(side);
    if (name == NULL) name = json_string_value(json_object_get(side, "body"));
    return name != NULL ? name : "?";
}

static bool event_of(const json_t *json, event *e)
{
    const json_t *t = json_object_get(json, "t");
    const char *kind = json_string_value(json_object_get(json, "kind"));
    if (!json_is_number(t) || !recorded_vector(json_object_get(json, "point"), &e->point))
        return false;
    e->t = json_number_value(t);
    e->has_normal = recorded_vector(json_object_get(json, "normal"), &e->normal);
    snprintf(e->what, sizeof e->what, "%.24s: %.60s and %.60s", kind != NULL ? kind : "event",
             body_of(json_object_get(json, "a")), body_of(json_object_get(json, "b")));
    return true;
}

static int by_time(const void *a, const void *b)
{
    const double s = ((const event *)a)->t, t = ((const event *)b)->t;
    return s < t ? -1 : s > t;
}

bool events_read(const json_t *scene, event_list *list)
{
    const json_t *events = json_object_get(scene, "events");
    const size_t count = json_array_size(events);
    *list = (event_list){.event = calloc(count + 1, sizeof *list->event)};
    for (size_t k = 0; k < count && list->event != NULL; ++k)
        list->count += event_of(json_array_get(events, k), &list->event[list->count]);
    if (list->count > 0) qsort(list->event, list->count, sizeof *list->event, by_time);
    return list->event != NULL;
}

void events_free(event_list *list)
{
    free(list->event);
    *list = (event_list){.event = NULL};
}
