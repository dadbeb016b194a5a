/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_LEGEND_H
#define TOOLS_VIEW_LEGEND_H

#include "tools/view/canvas.h"
#include "tools/view/stage.h"

/* The bodies' colours, in rows at the bottom of a picture. Entries do not overlap. If the bodies
 * need more than a third of the picture, the last entry counts the rest. A body without a surface
 * is not shown. */

/* Returns its height in pixels, with a note at its end. */
double legend_height(const stage *s, const canvas *c, const char *note);

/* Draws it; `note` is no longer than the one it was measured with. */
void legend_draw(const stage *s, canvas *c, const char *note);

#endif
