/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_STROKE_FONT_H
#define TOOLS_VIEW_STROKE_FONT_H

/* Letters as strokes
 * ==================
 * Each is a text of points, two digits a point: x from 0 to 4, y from 0 (the foot of a g) by 2 (the
 * baseline) to 8 (the top of an A). Points that follow each other are joined; a blank lifts the
 * pen.
 */

enum { STROKE_ADVANCE = 6, STROKE_LINE = 11 }; /* units from letter to letter, from line to line */

/* Returns the strokes of a letter; those of '?' for a byte without strokes. */
const char *stroke_of(char letter);

#endif
