/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "input.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "build_tree.h"

static bool is_standard_input(const char *path) { return strcmp(path, "-") == 0; }

const char *input_name(const char *path)
{
    return is_standard_input(path) ? "standard input" : path;
}

FILE *input_open(const char *path, const char *verb)
{
    if (is_standard_input(path)) return stdin;
    FILE *file = fopen(path, "r");
    if (file == NULL) complain(EXIT_DATA, verb, "%s: %s", path, strerror(errno));
    return file;
}

void input_close(FILE *file)
{
    if (file != stdin) fclose(file);
}

/* Doubles the buffer. */
static bool grow(char **text, size_t *size)
{
    const size_t larger = *size > 0 ? 2 * *size : 65536;
    char *moved = realloc(*text, larger);
    if (moved == NULL) return false;
    *text = moved;
    *size = larger;
    return true;
}

bool input_read(FILE *file, const char *name, const char *verb, char **text, size_t *length)
{
    size_t size = 0;
    *text = NULL;
    *length = 0;
    do {
        if (*length == size && !grow(text, &size)) {
            complain_of_memory(verb);
            return false;
        }
        *length += fread(*text + *length, 1, size - *length, file);
    } while (!feof(file) && !ferror(file));
    if (ferror(file)) complain(EXIT_DATA, verb, "%s: %s", name, strerror(errno));
    return !ferror(file);
}

bool input_is_same(const char *a, const char *b)
{
    struct stat a_is, b_is;
    return stat(a, &a_is) == 0 && stat(b, &b_is) == 0 && a_is.st_dev == b_is.st_dev &&
           a_is.st_ino == b_is.st_ino;
}

char *input_package_file(const char *name, const char *verb)
{
    const char *built = build_tree_data();
    char *path;
    if (asprintf(&path, "%s/%s", built != NULL ? built : PKGDATADIR, name) >= 0) return path;
    complain_of_memory(verb);
    return NULL;
}
