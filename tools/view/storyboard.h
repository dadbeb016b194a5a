/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STORYBOARD_H
#define TOOLS_VIEW_STORYBOARD_H

#include "tools/view/canvas.h"
#include "tools/view/request.h"
#include "tools/view/subject.h"

/* The scene in panels: start, contact, end, and the contact from near; without a contact the
 * nearest approach in its place. With --at, that moment alone. */

/* Draws it all. *error_upper: how far any surface is from what stands for it, length. */
imp_code storyboard_draw(subject *what, const view_request *request, canvas *c, double *error_upper,
                         imp_error *error);

/* The stage for these moments, which it takes over (NULL: no memory). */
imp_code storyboard_stage(subject *what, const view_request *request, double *moments, size_t count,
                          stage *s, imp_error *error);

/* From where to look: as the request says, or so that the spot is in front; where none is known, as
 * usual. The stage is left at the spot's time. */
imp_code storyboard_direction(stage *s, const view_request *request, direction *from,
                              imp_error *error);

#endif
