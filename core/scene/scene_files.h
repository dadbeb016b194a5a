/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_SCENE_SCENE_FILES_H
#define CORE_SCENE_SCENE_FILES_H

#include <stdbool.h>
#include <stddef.h>

/* The files that values of a scene's instances name, for its certificates. */

typedef struct scene_file {
    char *path;       /* as create was given it; to be freed */
    const char *name; /* the end of `path`, from the folder of the scene's file on */
} scene_file;

typedef struct scene_files {
    scene_file *at;
    size_t count, capacity;
} scene_files; /* begins as {0} */

/* Adds a file. `folder` (with '/' at its end; NULL: none) is that of the scene's file. False: no
 * memory. */
bool scene_files_add(scene_files *f, const char *path, const char *folder);

/* Adds all files of another list. */
bool scene_files_copy(const scene_files *from, scene_files *to);

void scene_files_clear(scene_files *f);

#endif
