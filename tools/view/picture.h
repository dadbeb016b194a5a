/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PICTURE_H
#define TOOLS_VIEW_PICTURE_H

#include <jansson.h>

#include "tools/view/camera.h"
#include "tools/view/canvas.h"
#include "tools/view/stage.h"

/* What one panel of a picture shows: the stage at its time, shaded into the canvas's pixels or as
 * lines, those that are hidden fainter. */

typedef struct panel {
    raster_window window;
    camera camera;
    char title[96];
    bool marks; /* the contact's point and normal */
} panel;

/* The colour of a body. */
colour picture_body_colour(size_t body);

/* As "#rrggbb". */
json_t *picture_colour_json(colour c);

/* Draws the stage where stage_move put it. IMP_ERROR_MEMORY or IMP_SUCCESS. */
imp_code picture_draw(const stage *s, const panel *p, canvas *c, imp_error *error);

/* From where to look, in degrees. */
typedef struct direction {
    double azimuth, elevation;
} direction;

/* The direction in which nothing hides the contact, its normal is seen from the side, and little
 * else is strange; the stage stands at the contact. */
imp_code picture_choose(const stage *s, direction *chosen, imp_error *error);

/* Centres and scales the camera so that all of the stage is inside the window, with a margin. */
void picture_frame(camera *c, const raster_window *w, const stage *s);

#endif
