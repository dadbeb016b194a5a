/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STORYBOARD_H
#define TOOLS_VIEW_STORYBOARD_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* The scene in four panels: start, contact, end, and the contact from near; without a contact, four
 * moments. With --at, that moment alone. */

/* Draws it all. *error_upper: how far any surface is from what stands for it, length. */
imp_code storyboard_draw(const subject *what, const view_request *request, canvas *c,
                         double *error_upper, imp_error *error);

/* The stage for these moments, which it takes over (NULL: no memory). */
imp_code storyboard_stage(const subject *what, const view_request *request, double *moments,
                          size_t count, stage *s, imp_error *error);

/* From where to look: as the request says, or so that the contact is in front. */
imp_code storyboard_direction(stage *s, const view_request *request, direction *from,
                              imp_error *error);

#endif
