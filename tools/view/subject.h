/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_SUBJECT_H
#define TOOLS_VIEW_SUBJECT_H

#include "tools/cli/arguments.h"
#include "tools/view/at_values.h"
#include "tools/view/events.h"
#include "tools/view/stage.h"

/* The subject of a picture: a scene file, a result that names one, or two surfaces; with its query,
 * contact and nearest approach. */

typedef struct subject {
    imp_registry *registry;
    imp_scene *scene;
    imp_query *query; /* finished; NULL if the answer was read */
    imp_options options;
    size_t body_count;   /* bodies from here on are not drawn; 0: all are */
    allowance allowance; /* of the whole verb */
    stage_contact contact;
    stage_spot spot;   /* the contact; else the nearest approach, once it was searched */
    bool has_looked;   /* the nearest approach was searched for, or read */
    event_list events; /* of a simulation */
    char title
        [256]; /* the scene's name: its file, or the two surfaces; and what t is, if not time */
    values_text values; /* at which the scene stands */
    const char *axis;   /* what moments are of: "t", or the parameter that is swept */
} subject;

/* Reads the operands and solves, unless they are a result. Complains. Free in any case. */
exit_status subject_read(subject *s, const arguments *args);

/* Like subject_read, for a scene file; the operands are ignored. */
exit_status subject_of_file(subject *s, const char *path, const arguments *args);

/* Finds the nearest approach where there is no contact. */
imp_code subject_find_nearest(subject *s, imp_error *error);

void subject_free(subject *s);

#endif
