/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_NAMED_FILES_H
#define CORE_BASE_NAMED_FILES_H

#include <stdbool.h>
#include <stddef.h>

#include "core/base/file_state.h"

/* The files that values of a scene's instances name, for its certificates. */

typedef struct named_file {
    char *path;       /* as create was given it; to be freed */
    const char *name; /* the end of `path`, from the folder of the scene's file on */
    file_state state; /* when it was added, before its contents were used; 0: no regular file */
} named_file;

typedef struct named_files {
    named_file *at;
    size_t count, capacity;
} named_files; /* begins as {0} */

/* Adds a file, before its contents are used. `folder` (with '/' at its end; NULL: none) is that of
 * the scene's file. False: no memory. */
bool named_files_add(named_files *f, const char *path, const char *folder);

/* Adds all files of another list. */
bool named_files_copy(const named_files *from, named_files *to);

void named_files_clear(named_files *f);

#endif
