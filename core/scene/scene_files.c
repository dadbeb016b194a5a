/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/scene/scene_files.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

static bool add(scene_files *f, const char *path, size_t skip)
{
    scene_file *grown = array_reserve(f->at, f->count, &f->capacity, sizeof *grown);
    if (grown == NULL) return false;
    f->at = grown;
    char *copy = strdup(path);
    if (copy == NULL) return false;
    grown[f->count++] = (scene_file){copy, copy + skip};
    return true;
}

bool scene_files_add(scene_files *f, const char *path, const char *folder)
{
    const size_t length = folder != NULL ? strlen(folder) : 0;
    const scene_file *last = f->count > 0 ? &f->at[f->count - 1] : NULL;
    if (last != NULL && strcmp(last->path, path) == 0) return true;
    return add(f, path, length > 0 && strncmp(path, folder, length) == 0 ? length : 0);
}

bool scene_files_copy(const scene_files *from, scene_files *to)
{
    bool kept = true;
    for (size_t k = 0; k < from->count && kept; ++k)
        kept = add(to, from->at[k].path, (size_t)(from->at[k].name - from->at[k].path));
    return kept;
}

void scene_files_clear(scene_files *f)
{
    for (size_t k = 0; k < f->count; ++k) free(f->at[k].path);
    free(f->at);
    *f = (scene_files){0};
}
