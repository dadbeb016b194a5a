/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_SUBJECT_H
#define TOOLS_VIEW_SUBJECT_H

#include "tools/cli/arguments.h"
#include "tools/view/stage.h"

/* What a verb of pictures is asked to show: a scene file, a result that names one, or two surfaces;
 * and what is found out about it. */

typedef struct subject {
    imp_registry *registry;
    imp_scene *scene;
    imp_query *query; /* run to its end; NULL where the answer was read */
    imp_options options;
    stage_contact contact;
} subject;

/* Reads the operands and solves, unless they are a result. Complains. Free in any case. */
exit_status subject_read(subject *s, const arguments *args);
/* The same of a scene file; the operands are not looked at. */
exit_status subject_of_file(subject *s, const char *path, const arguments *args);
void subject_free(subject *s);

#endif
