/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VIEW_H
#define TOOLS_VIEW_VIEW_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* From a subject to a file: the format is what the file's name ends with, in letters of either
 * case. */

/* Whether files with this ending can be written. */
bool view_has(const char *ending);

/* Complains of a name that no format has, or whose format was not built in. */
exit_status view_check_output(const view_request *request);

/* What was written. */
typedef struct written {
    size_t width, height;      /* pixels; 0: it is no picture, */
    size_t moments, triangles; /* but these */
    double error_upper;        /* how far any surface is from what stands for it, length */
} written;

/* Writes the file. Complains; then there is no file. */
exit_status view_write(subject *what, const view_request *request, written *w);

/* view_write, and one line about it; with request->json an object. */
exit_status view_write_and_tell(subject *what, const view_request *request);

#endif
