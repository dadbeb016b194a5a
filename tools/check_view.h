/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CHECK_VIEW_H
#define TOOLS_CHECK_VIEW_H

#include "check_branch.h"

/* A region, and what is known of boxes in it
 * ===========================================
 * Boxes are of the normalized numbers s, in which what is linear is so exactly; p = c + d s is
 * never beyond the region by more than its ends need in rounding, and then the view is of a little
 * more than the region: what holds there, holds in the region. */

typedef struct frame {
    const branch_field *field;
    const branch_claims *claims;
    span whole[BOX_DIMS];    /* s over the region, or a little more */
    bool is_exact[BOX_DIMS]; /* no more */
} frame;

frame frame_make(const branch_field *field, const branch_claims *claims);

/* x, y, z and, where wanted, how far they are off the model's quadratic: over the box, and at its
 * middle, from which `offset` leads into the box. */
typedef struct view {
    span offset[BOX_DIMS], middle[BOX_DIMS];
    jet box[3], centre[3], off_box[3], off_centre[3];
    bool has_point; /* the middle surely is one of the region */
} view;

void frame_look(const frame *f, const span x[BOX_DIMS], const bool off_wanted[3], view *v);

/* Is coordinate i in its range over the box? Not asked of a little more: ranges may end where the
 * region does, with nothing to spare. False: perhaps. */
bool frame_is_in_range(const frame *f, const span x[BOX_DIMS], int i);

#endif
