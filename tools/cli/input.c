/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/input.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/common/system_error.h"
#include "tools/cli/build_tree.h"

static bool is_standard_input(const char *path) { return strcmp(path, "-") == 0; }

const char *input_name(const char *path)
{
    return is_standard_input(path) ? "standard input" : path;
}

FILE *input_open(const char *path, const char *verb)
{
    if (is_standard_input(path)) return stdin;
    FILE *file = fopen(path, "r");
    if (file == NULL) complain(EXIT_DATA, verb, "%s: %s", path, system_error_text(errno));
    return file;
}

void input_close(FILE *file)
{
    if (file != stdin) fclose(file);
}

#define INPUT_MAX ((size_t)1 << 30) /* bytes; as for scene files */

/* Doubles the buffer. */
static bool grow(input_text *t)
{
    const size_t larger = t->size > 0 ? 2 * t->size : 65536;
    char *moved = realloc(t->text, larger);
    if (moved == NULL) return false;
    t->text = moved;
    t->size = larger;
    return true;
}

static size_t most_bytes(const input_text *t)
{
    return t->most > 0 && t->most < INPUT_MAX ? t->most : INPUT_MAX;
}

/* Up to `end`, or the end of the file; false: errno says why not. */
static bool take(FILE *file, int end, input_text *t)
{
    const size_t most = most_bytes(t);
    for (t->length = 0;;) {
        if (t->length == t->size && !grow(t)) return false;
        errno = 0;
        const int c = getc_unlocked(file);
        if (c == EOF) return !ferror(file);
        if (t->length == most) break;
        t->text[t->length++] = (char)c;
        if (c == end) return true;
    }
    errno = EFBIG;
    t->is_too_long = true;
    return false;
}

static bool judge(bool taken, const input_text *t, const char *name, const char *what,
                  const char *verb)
{
    if (taken || errno == EINTR) return taken;
    if (errno == EFBIG)
        complain(EXIT_DATA, verb, "%s: %s longer than %zu bytes", name, what, most_bytes(t));
    else
        complain(EXIT_DATA, verb, "%s: %s", name, system_error_text(errno));
    return false;
}

bool input_read(FILE *file, const char *name, const char *verb, input_text *text)
{
    return judge(take(file, EOF, text), text, name, "it is", verb);
}

bool input_read_line(FILE *file, const char *name, const char *verb, input_text *line)
{
    return judge(take(file, '\n', line), line, name, "it has a line", verb);
}

bool input_is_file(const char *path)
{
    struct stat is;
    return !is_standard_input(path) && stat(path, &is) == 0 && S_ISREG(is.st_mode);
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
