/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_WATCHED_FILES_H
#define TOOLS_CLI_WATCHED_FILES_H

#include <stdbool.h>
#include <stddef.h>

#include "tools/cli/message.h"

/* Waiting for changes of a few files
 * ==================================
 * Their folders are watched (inotify), because editors replace files rather than write them. */

enum { WATCHED_MOST = 4 };

typedef struct watched_files {
    int notices; /* descriptor of inotify; -1: none */
    size_t count;
    int folder[WATCHED_MOST];       /* watches of the folders */
    const char *name[WATCHED_MOST]; /* files in them: the caller's texts */
} watched_files;

/* Begins to watch the files. Complains on behalf of `verb` of a folder that cannot be watched. */
exit_status watched_files_begin(watched_files *w, const char *const *paths, size_t count,
                                const char *verb);

/* Waits until one of the files was written or replaced, and no other change has followed for a
 * tenth of a second. False: a signal came first (interrupt_came), or nothing can be read. */
bool watched_files_wait(watched_files *w);

void watched_files_end(watched_files *w);

#endif
