/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_FILE_LOCK_H
#define TOOLS_CLI_FILE_LOCK_H

#include <sys/stat.h>

#include "tools/cli/message.h"

/* One writer a file
 * =================
 * An advisory lock (fcntl) on a file beside an output. It ends with the process, however that ends;
 * but also when the process closes any descriptor of the file, so it is a file that nothing else
 * here opens. */

typedef struct file_lock {
    const char *file;   /* to be opened, or made, and locked */
    const char *output; /* for messages: what the lock guards */
    const char *verb;
} file_lock;

/* Opens the file for reading and writing, and locks it: *fd, described by *is. Complains if another
 * process is writing the output, and names it; and if another user may have planted the file. On a
 * file system without locks it counts as locked. *fd is -1 unless EXIT_ANSWERED is returned. */
exit_status file_lock_open(const file_lock *lock, int *fd, struct stat *is);

#endif
