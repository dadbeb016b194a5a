/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_COMMON_SEARCH_PATH_H
#define CORE_COMMON_SEARCH_PATH_H

#include <stdbool.h>
#include <stddef.h>

/* Where plugins are looked for
 * ============================
 * Directories in order; what is found earlier wins. Somebody who names a directory wants to
 * hear if it is missing; a default one may well be. */

typedef struct search_directory {
    char *path;
    bool named; /* by an argument or the environment */
} search_directory;

typedef struct search_path {
    search_directory *directory;
    size_t count, capacity;
} search_path;

/* All of these return false when memory runs out; clear the path in any case. */

/* Adds the directories of a colon-separated list; empty elements are skipped. NULL adds none. */
bool search_path_add(search_path *path, const char *list, bool named);

/* Adds, in this order: `list`; IMPINGE_PLUGIN_PATH; the user's plugins, in $XDG_DATA_HOME/impinge/1
 * or else $HOME/.local/share/impinge/1; the installed plugins. The environment is ignored if the
 * process is privileged (setuid and the like). */
bool search_path_add_defaults(search_path *path, const char *list);

void search_path_clear(search_path *path);

/* Whether a name ends in ".so" and has more than that. */
bool is_named_so(const char *name);

/* Names in a directory that may be plugins: ending in ".so", not beginning with a dot, in
 * bytewise order whatever the file system's. */
typedef struct plugin_names {
    char **name;
    size_t count, capacity;
} plugin_names;

typedef enum names_status {
    NAMES_READ,
    NAMES_NO_DIRECTORY,
    NAMES_UNREADABLE,
    NAMES_MEMORY
} names_status;

/* UNREADABLE: errno says why. Clear the names in any case. */
names_status plugin_names_read(plugin_names *names, const char *directory);

void plugin_names_clear(plugin_names *names);

#endif
