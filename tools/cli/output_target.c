/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/output_target.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Names of descriptors --------------------------------------------------------------------- */

/* Returns the descriptor that the name stands for, or -1. Such names are links that lead nowhere,
 * or to a file that must not be replaced, so they are recognised by their spelling. */
static int descriptor_of(const char *path)
{
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/", "/proc/thread-self/fd/"};
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0) return STDOUT_FILENO;
    if (strcmp(path, "/dev/stderr") == 0) return STDERR_FILENO;
    for (size_t k = 0; k < sizeof folders / sizeof *folders; ++k) {
        const size_t length = strlen(folders[k]);
        int number;
        char rest;
        if (strncmp(path, folders[k], length) != 0) continue;
        if (strspn(path + length, "0123456789") != strlen(path + length)) continue;
        if (sscanf(path + length, "%9d%c", &number, &rest) == 1) return number;
    }
    return -1;
}

/* --- Links ------------------------------------------------------------------------------------ */

/* Returns the link's target, relative to the folder it is in; NULL: no link (errno EINVAL), or an
 * error. */
static char *read_link(const char *path)
{
    char text[PATH_MAX], *to;
    const ssize_t length = readlink(path, text, sizeof text - 1);
    if (length < 0) return NULL;
    text[length] = '\0';
    const char *slash = text[0] == '/' ? NULL : strrchr(path, '/');
    const int folder = slash != NULL ? (int)(slash + 1 - path) : 0;
    return asprintf(&to, "%.*s%s", folder, path, text) >= 0 ? to : NULL;
}

/* Returns the name at the end of all links, including those of descriptors. NULL: see errno. */
static char *follow_links(const char *path)
{
    enum { LINKS_MAX = 40 }; /* as the system allows */
    char *name = strdup(path);
    for (int k = 0; name != NULL && k < LINKS_MAX; ++k) {
        char *next = descriptor_of(name) < 0 ? read_link(name) : NULL;
        if (next == NULL) return name;
        free(name);
        name = next;
    }
    if (name != NULL) errno = ELOOP;
    free(name);
    return NULL;
}

/* --- What is there ---------------------------------------------------------------------------- */

static output_target refused(int error)
{
    errno = error;
    return (output_target){.kind = OUTPUT_REFUSED};
}

/* Takes ownership of the name, whose links are resolved. */
static output_target look_at(char *name, const char *path)
{
    output_target target = {.kind = OUTPUT_FILE, .path = name};
    const bool exists = stat(path, &target.there) == 0;
    struct stat named;
    const int error = exists ? 0 : errno;
    if (!exists && error == ENOENT) {
        target.kind = OUTPUT_NEW;
        return target;
    }
    if (exists && S_ISREG(target.there.st_mode) && stat(name, &named) == 0 &&
        named.st_dev == target.there.st_dev && named.st_ino == target.there.st_ino)
        return target;
    free(name);
    if (!exists) return refused(error);
    if (S_ISDIR(target.there.st_mode)) return refused(EISDIR);
    return (output_target){.kind = OUTPUT_STREAM};
}

output_target output_target_of(const char *path)
{
    char *name = follow_links(path);
    if (name == NULL) return refused(errno);
    const int number = descriptor_of(name);
    if (number < 0) return look_at(name, path);
    free(name);
    return (output_target){.kind = number == STDOUT_FILENO ? OUTPUT_STANDARD : OUTPUT_DESCRIPTOR,
                           .number = number};
}

bool output_is_standard(const char *path)
{
    const output_target target = output_target_of(path);
    free(target.path);
    return target.kind == OUTPUT_STANDARD;
}
