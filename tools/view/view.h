/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VIEW_H
#define TOOLS_VIEW_VIEW_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* Writes a picture of a subject: the ending of the file's name, in letters of either case, selects
 * the format. */

/* Returns whether files with this ending can be written. */
bool view_has(const char *ending);

/* Complains of an ending without a format, or whose format was not built in. */
exit_status view_check_output(const view_request *request);

/* Facts about the written file. */
typedef struct written {
    size_t width, height;      /* pixels; 0: it is no picture, */
    size_t moments, triangles; /* but these */
    double error_upper; /* bounds the distance of any surface from its drawn triangles, length */
} written;

/* Writes the file. Complains; then there is no file. */
exit_status view_write(subject *what, const view_request *request, written *w);

/* Calls view_write, and prints one line about it; with request->json an object. */
exit_status view_write_and_tell(subject *what, const view_request *request);

#endif
