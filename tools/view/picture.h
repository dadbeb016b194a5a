/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PICTURE_H
#define TOOLS_VIEW_PICTURE_H

#include "tools/view/camera.h"
#include "tools/view/canvas.h"
#include "tools/view/stage.h"

/* Draws one panel of a picture: the stage at its time, shaded into the canvas's pixels or as lines,
 * hidden lines fainter. Bodies in front of the spot are transparent. */

typedef struct panel {
    raster_window window;
    camera camera;
    char title[768]; /* drawn in as many lines as it needs, up to three */
    bool
        marks; /* the spot: where they touch, with the normal, or come nearest, with the distance */
} panel;

/* Draws the stage where stage_move put it. */
imp_code picture_draw(const stage *s, const panel *p, canvas *c, imp_error *error);

/* Returns the pixels above the middle that a title takes in a panel of that width. */
double picture_title_height(const canvas *c, double width, const char *title);

/* Centres and scales the camera so that all of the stage is inside the window below a title of that
 * height, with a margin. */
void picture_frame(camera *c, const raster_window *w, const stage *s, double title);

#endif
