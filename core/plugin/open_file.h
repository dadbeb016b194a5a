/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_PLUGIN_OPEN_FILE_H
#define CORE_PLUGIN_OPEN_FILE_H

#include <fcntl.h>

/* Opens what should be a regular file for reading, which the caller checks (fstat). -1: see errno.
 * Without O_NONBLOCK, opening a pipe waits for a writer. */
static inline int open_file(const char *path)
{
    return open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
}

#endif
