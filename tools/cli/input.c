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

enum {
    BLOCK = 1024 /* bytes of a line taken at once, at most; all of them are written twice */
};

/* Makes room for one more byte at least, and for the NUL of a block. */
static bool make_room(input_text *t)
{
    if (t->length + 1 < t->size) return true;
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

/* Appends up to n bytes of the file's line, n + 1 of which there is room for. True: the line has
 * ended. A pipe is not waited for behind the end of a line.
 *
 * Lemma: the first line end in what fgets leaves of n + 1 line ends is the one that it read, behind
 * which it wrote its NUL; or, if it read none, the first behind that NUL, or there is none since
 * the NUL is the last byte. What was read may have NULs. */
static bool append_of_line(FILE *file, size_t n, input_text *t)
{
    char *const block = t->text + t->length;
    memset(block, '\n', n + 1);
    if (fgets_unlocked(block, (int)(n + 1), file) == NULL) return false;
    const char *const end = memchr(block, '\n', n + 1);
    const bool has_ended = end != NULL && end < block + n && end[1] == '\0';
    t->length += end == NULL ? n : (size_t)(end - block) + (size_t)has_ended - (size_t)!has_ended;
    return has_ended;
}

/* One step of taking the file up to `end`, or its end, whichever is first: *done if that is there.
 * False: errno says why not. */
static bool take_block(FILE *file, int end, input_text *t, bool *done)
{
    const size_t left = most_bytes(t) - t->length;
    errno = 0;
    if (left == 0) {
        *done = true;
        if (getc_unlocked(file) == EOF) return !ferror(file);
        errno = EFBIG;
        t->is_too_long = true;
        return false;
    }
    if (!make_room(t)) return false;
    const size_t room = t->size - 1 - t->length, most = room < left ? room : left;
    if (end == EOF)
        t->length += fread_unlocked(t->text + t->length, 1, most, file);
    else
        *done = append_of_line(file, most < BLOCK ? most : BLOCK, t);
    if (*done) return true;
    *done = feof(file) || ferror(file);
    return !ferror(file);
}

/* Up to `end`, or the end of the file; false: errno says why not. */
static bool take(FILE *file, int end, input_text *t)
{
    bool done = false, taken = true;
    for (t->length = 0; taken && !done;) taken = take_block(file, end, t, &done);
    return taken;
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
