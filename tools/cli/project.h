/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROJECT_H
#define TOOLS_CLI_PROJECT_H

#include "tools/cli/message.h"

/* A folder of files made from the package's templates
 * ===================================================
 * A template is a text in which words such as @name@ are replaced for each project. Either every
 * file is written or none. */

typedef struct project_word {
    const char *word; /* "name" for @name@ */
    const char *value;
} project_word;

typedef struct project_file {
    const char *template; /* file in the package's folder "template" */
    const char *path;     /* in the project; at most four folders deep */
    bool executable;
} project_file;

/* Writes the files into `folder`, which is made if it does not exist, and must be empty if it does.
 * Both tables end with NULL. Complains on behalf of `verb`. */
exit_status project_write(const char *folder, const project_file *files, const project_word *words,
                          const char *verb);

#endif
