/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_PNG_H
#define TOOLS_VIEW_PNG_H

#include <stdio.h>

#include "tools/cli/message.h"
#include "tools/view/raster.h"

/* Pictures as PNG, where the command was built with libpng. */

bool png_is_available(void);

/* Complains, with the cure, if the file cannot be written because libpng is missing. */
exit_status png_check(const char *path, const char *verb);

/* False: it could not be written, or there is no libpng. */
bool png_write_raster(FILE *file, const raster *r);

#endif
