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
    char title[256];
    bool
        marks; /* the spot: where they touch, with the normal, or come nearest, with the distance */
} panel;

/* Draws the stage where stage_move put it. */
imp_code picture_draw(const stage *s, const panel *p, canvas *c, imp_error *error);

/* Centres and scales the camera so that all of the stage is inside the window, with a margin. */
void picture_frame(camera *c, const raster_window *w, const stage *s);

#endif
