/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_NEAREST_H
#define TOOLS_VIEW_NEAREST_H

#include "tools/view/stage.h"

/* Finds where bodies come nearest to each other in the times of the options: *spot, with the
 * distance to within a thousandth of it. If a limit ends the search, it is the nearest found so
 * far, if any. It is not known if no two bodies exist together. */
imp_code nearest_find(imp_scene *scene, const imp_options *options, stage_spot *spot,
                      imp_error *error);

/* Returns the spot of an answer. */
stage_spot nearest_of(const imp_clearance *answer, double gamma);

#endif
