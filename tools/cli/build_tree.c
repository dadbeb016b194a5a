/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/build_tree.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Takes the last part off `path` if it is `name`, or any part if name is NULL. */
static bool cut_last(char *path, const char *name)
{
    char *slash = strrchr(path, '/');
    if (slash == NULL || (name != NULL && strcmp(slash + 1, name) != 0)) return false;
    *slash = '\0';
    return true;
}

/* libtool puts programs that are linked with libimpinge.so into tools/.libs, others into tools. */
static bool find_top(char *top, size_t size)
{
    ssize_t length = readlink("/proc/self/exe", top, size - 1);
    if (length <= 0) return false;
    top[length] = '\0';
    if (!cut_last(top, NULL)) return false;
    cut_last(top, ".libs");
    return cut_last(top, "tools");
}

static bool join(char *path, size_t size, const char *top, const char *rest)
{
    int length = snprintf(path, size, "%s%s", top, rest);
    return length > 0 && (size_t)length < size && access(path, R_OK) == 0;
}

static const char *find_directory(char *path, size_t size, const char *rest)
{
    char top[PATH_MAX];
    if (!find_top(top, sizeof top)) return NULL;
    if (!join(path, size, top, "/config.status")) return NULL;
    return join(path, size, top, rest) ? path : NULL;
}

const char *build_tree_plugins(void)
{
    static char plugins[PATH_MAX];
    return find_directory(plugins, sizeof plugins, "/plugins/.libs");
}

const char *build_tree_data(void)
{
    static char data[PATH_MAX];
    return find_directory(data, sizeof data, "/tools/built-data");
}
