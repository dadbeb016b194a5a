/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STORYBOARD_H
#define TOOLS_VIEW_STORYBOARD_H

#include "tools/view/canvas.h"
#include "tools/view/request.h"
#include "tools/view/subject.h"

/* The scene in panels: start, contact, end, and a close-up of the contact; without a contact, the
 * nearest approach instead. With --at, that moment alone. */

/* Draws all panels. *error_upper bounds the distance of any surface from its drawn triangles,
 * length. */
imp_code storyboard_draw(subject *what, const view_request *request, canvas *c, double *error_upper,
                         imp_error *error);

/* Makes the stage for these moments, and takes ownership of them (NULL: no memory). */
imp_code storyboard_stage(subject *what, const view_request *request, double *moments, size_t count,
                          stage *s, imp_error *error);

/* Chooses the view's direction: that of the request, or one in which nothing hides the spot, or the
 * default without a spot. The stage is left at the spot's time. */
imp_code storyboard_direction(stage *s, const view_request *request, direction *from,
                              imp_error *error);

#endif
