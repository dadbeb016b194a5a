/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_VIEW_VIEW_H
#define TOOLS_VIEW_VIEW_H

#include "tools/view/request.h"
#include "tools/view/subject.h"

/* From a subject to a file: the format is what the file's name ends with. */

/* Whether files with this ending can be written. */
bool view_has(const char *ending);

/* Complains of a name that no format has, or whose format was not built in. */
exit_status view_check_output(const view_request *request);

/* Writes the file and prints one line about it. Complains; then there is no file. */
exit_status view_write(const subject *what, const view_request *request);

#endif
