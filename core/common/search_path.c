/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/array.h"
#include "core/common/search_path.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include <impinge/surface.h>

#define USER_FOLDER "impinge/" IMP_TEXT_OF(IMP_ABI_MAJOR)

/* --- Directories ------------------------------------------------------------------------------ */

/* Takes over `directory`; NULL is memory that ran out before. */
static bool add_directory(search_path *path, char *directory, bool named)
{
    search_directory *grown = directory != NULL ? array_reserve(path->directory, path->count,
                                                                &path->capacity, sizeof *grown)
                                                : NULL;
    if (grown == NULL) {
        free(directory);
        return false;
    }
    path->directory = grown;
    path->directory[path->count++] = (search_directory){directory, named};
    return true;
}

static char *joined(const char *a, const char *b, size_t b_length)
{
    size_t size = strlen(a) + b_length + 1;
    char *text = malloc(size);
    if (text != NULL) snprintf(text, size, "%s%.*s", a, (int)b_length, b);
    return text;
}

bool search_path_add(search_path *path, const char *list, bool named)
{
    while (list != NULL && *list) {
        size_t length = strcspn(list, ":");
        if (length > 0 && !add_directory(path, joined("", list, length), named)) return false;
        list += length + (list[length] == ':');
    }
    return true;
}

/* The XDG base directory specification: a path that is not absolute counts as not set. */
static bool add_user_directory(search_path *path)
{
    const char *data = secure_getenv("XDG_DATA_HOME"), *home = secure_getenv("HOME");
    const char *below_data = "/" USER_FOLDER, *below_home = "/.local/share/" USER_FOLDER;
    if (data != NULL && data[0] == '/')
        return add_directory(path, joined(data, below_data, strlen(below_data)), false);
    if (home != NULL && home[0] == '/')
        return add_directory(path, joined(home, below_home, strlen(below_home)), false);
    return true;
}

bool search_path_add_defaults(search_path *path, const char *list)
{
    return search_path_add(path, list, true) &&
           search_path_add(path, secure_getenv("IMPINGE_PLUGIN_PATH"), true) &&
           add_user_directory(path) &&
           add_directory(path, joined("", PLUGINDIR, strlen(PLUGINDIR)), false);
}

void search_path_clear(search_path *path)
{
    for (size_t i = 0; i < path->count; ++i) free(path->directory[i].path);
    free(path->directory);
    *path = (search_path){.count = 0};
}

/* --- What is in one --------------------------------------------------------------------------- */

bool is_named_so(const char *name)
{
    const size_t length = strlen(name);
    return length > 3 && strcmp(name + length - 3, ".so") == 0;
}

static int compare_names(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static bool add_name(plugin_names *names, const char *name)
{
    char **grown = array_reserve(names->name, names->count, &names->capacity, sizeof *grown);
    if (grown == NULL) return false;
    names->name = grown;
    names->name[names->count] = strdup(name);
    return names->name[names->count] != NULL && ++names->count;
}

static names_status read_names(plugin_names *names, DIR *stream)
{
    for (;;) {
        errno = 0;
        const struct dirent *entry = readdir(stream);
        if (entry == NULL) return errno ? NAMES_UNREADABLE : NAMES_READ;
        if (entry->d_name[0] != '.' && is_named_so(entry->d_name) &&
            !add_name(names, entry->d_name))
            return NAMES_MEMORY;
    }
}

names_status plugin_names_read(plugin_names *names, const char *directory)
{
    *names = (plugin_names){.count = 0};
    DIR *stream = opendir(directory);
    if (stream == NULL) return errno == ENOENT ? NAMES_NO_DIRECTORY : NAMES_UNREADABLE;
    names_status status = read_names(names, stream);
    int saved = errno;
    closedir(stream);
    errno = saved;
    if (status == NAMES_READ && names->count > 0)
        qsort(names->name, names->count, sizeof *names->name, compare_names);
    return status;
}

void plugin_names_clear(plugin_names *names)
{
    for (size_t i = 0; i < names->count; ++i) free(names->name[i]);
    free(names->name);
    *names = (plugin_names){.count = 0};
}
