/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/named_files.h"

#include <stdlib.h>
#include <string.h>

#include "core/common/array.h"

static bool add(named_files *f, const char *path, size_t skip, const file_state *state)
{
    named_file *grown = array_reserve(f->at, f->count, &f->capacity, sizeof *grown);
    if (grown == NULL) return false;
    f->at = grown;
    char *copy = strdup(path);
    if (copy == NULL) return false;
    grown[f->count++] = (named_file){copy, copy + skip, *state};
    return true;
}

bool named_files_add(named_files *f, const char *path, const char *folder)
{
    const size_t length = folder != NULL ? strlen(folder) : 0;
    const named_file *last = f->count > 0 ? &f->at[f->count - 1] : NULL;
    file_state state;
    file_state_read(path, &state);
    if (last != NULL && strcmp(last->path, path) == 0 &&
        memcmp(&last->state, &state, sizeof state) == 0)
        return true;
    return add(f, path, length > 0 && strncmp(path, folder, length) == 0 ? length : 0, &state);
}

bool named_files_copy(const named_files *from, named_files *to)
{
    bool kept = true;
    for (size_t k = 0; k < from->count && kept; ++k)
        kept = add(to, from->at[k].path, (size_t)(from->at[k].name - from->at[k].path),
                   &from->at[k].state);
    return kept;
}

void named_files_clear(named_files *f)
{
    for (size_t k = 0; k < f->count; ++k) free(f->at[k].path);
    free(f->at);
    *f = (named_files){0};
}
