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

/* Opens the file for reading and writing, and locks it: *fd, described by *is. Complains that
 * another process is writing the output, and which; and of a file that another user may have put
 * there. A file system without locks counts as locked. *fd is -1 where it is not EXIT_ANSWERED. */
exit_status file_lock_open(const file_lock *lock, int *fd, struct stat *is);

#endif
