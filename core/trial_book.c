/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "array.h"
#include "plugin_trial.h"
#include "text.h"

#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The book is text, one trial a line, fields parted by tabs: code, device, inode, size, seconds and
 * nanoseconds of modification and of change, path, reason. Its first line names the version:
 * another one's book is not read. */

typedef struct trial {
    imp_code code;
    elf_identity file;
    char *path, *text;
} trial;

struct trial_book {
    trial *trials;
    size_t count, capacity;
    char *file; /* NULL: not kept */
    bool changed;
};

#define FIRST_LINE "impinge trials 2 of " PACKAGE_VERSION "\n"

/* $XDG_CACHE_HOME/impinge, else ~/.cache/impinge: both ignored when privileged. */
static char *cache_folder(void)
{
    const char *cache = secure_getenv("XDG_CACHE_HOME"), *home = secure_getenv("HOME");
    char *folder = NULL;
    if (cache != NULL && cache[0] == '/') {
        if (asprintf(&folder, "%s/impinge", cache) < 0) return NULL;
    } else if (home != NULL && home[0] == '/') {
        if (asprintf(&folder, "%s/.cache/impinge", home) < 0) return NULL;
    }
    return folder;
}

static char *book_file(void)
{
    char *folder = cache_folder(), *file = NULL;
    if (folder != NULL && asprintf(&file, "%s/trials", folder) < 0) file = NULL;
    free(folder);
    return file;
}

static void trial_clear(trial *t)
{
    free(t->path);
    free(t->text);
}

static bool add(trial_book *book, trial t)
{
    trial *grown = array_reserve(book->trials, book->count, &book->capacity, sizeof *grown);
    if (grown != NULL) book->trials = grown;
    if (grown == NULL || t.path == NULL || t.text == NULL) {
        trial_clear(&t);
        return false;
    }
    book->trials[book->count++] = t;
    return true;
}

/* A line that does not read as one is passed over: the file is tried again, that is all. False: no
 * memory. */
static bool read_line(trial_book *book, char *line)
{
    trial t = {0};
    elf_identity *f = &t.file;
    int code, path = 0;
    line[strcspn(line, "\n")] = '\0';
    if (sscanf(line,
               "%d\t%" SCNu64 "\t%" SCNu64 "\t%" SCNu64 "\t%" SCNd64 "\t%" SCNd64 "\t%" SCNd64
               "\t%" SCNd64 "\t%n",
               &code, &f->device, &f->inode, &f->size, &f->modified_s, &f->modified_ns,
               &f->changed_s, &f->changed_ns, &path) != 8 ||
        path == 0)
        return true;
    char *reason = strchr(line + path, '\t');
    if (reason == NULL || line[path] != '/') return true;
    if (code != IMP_SUCCESS && code != IMP_ERROR_PLUGIN) return true;
    *reason++ = '\0';
    t.code = (imp_code)code;
    t.path = strdup(line + path);
    t.text = strdup(reason);
    return add(book, t);
}

static bool read_lines(trial_book *book, FILE *in)
{
    char *line = NULL;
    size_t size = 0;
    bool good = true;
    if (getline(&line, &size, in) > 0 && strcmp(line, FIRST_LINE) == 0)
        while (good && getline(&line, &size, in) > 0) good = read_line(book, line);
    free(line);
    return good;
}

/* Whatever lies there, a pipe that nobody writes to or a device without end: only a file is read.
 */
static FILE *open_book(const char *file)
{
    struct stat facts;
    const int fd = open(file, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    FILE *in = fd >= 0 && fstat(fd, &facts) == 0 && S_ISREG(facts.st_mode) ? fdopen(fd, "r") : NULL;
    if (in == NULL && fd >= 0) close(fd);
    return in;
}

trial_book *trial_book_read(void)
{
    trial_book *book = calloc(1, sizeof *book);
    if (book == NULL) return NULL;
    book->file = book_file();
    FILE *in = book->file != NULL ? open_book(book->file) : NULL;
    if (in == NULL) return book;
    const bool good = read_lines(book, in);
    fclose(in);
    if (good) return book;
    trial_book_close(book);
    return NULL;
}

static trial *find(const trial_book *book, const char *path)
{
    for (size_t k = 0; k < book->count; ++k)
        if (strcmp(book->trials[k].path, path) == 0) return &book->trials[k];
    return NULL;
}

static bool same(elf_identity a, elf_identity b)
{
    return a.device == b.device && a.inode == b.inode && a.size == b.size &&
           a.modified_s == b.modified_s && a.modified_ns == b.modified_ns &&
           a.changed_s == b.changed_s && a.changed_ns == b.changed_ns;
}

bool trial_book_find(const trial_book *book, const char *path, const elf_probe *file,
                     imp_code *code, const char **text)
{
    const trial *t = find(book, path);
    if (t == NULL || !same(t->file, file->file)) return false;
    *code = t->code;
    *text = t->text;
    return true;
}

bool trial_book_add(trial_book *book, const char *path, const elf_probe *file, imp_code code,
                    const char *text)
{
    if (strpbrk(path, "\t\n") != NULL) return true; /* tried every time */
    trial t = {code, file->file, strdup(path), strdup(text)};
    for (char *c = t.text; c != NULL && *c != '\0'; ++c)
        if (*c == '\n') *c = ' ';
    trial *old = find(book, path);
    if (old != NULL && t.path != NULL && t.text != NULL) {
        trial_clear(old);
        *old = t;
    } else if (!add(book, t)) {
        return false;
    }
    book->changed = true;
    return true;
}

static bool write_all(const trial_book *book, FILE *out)
{
    fputs(FIRST_LINE, out);
    for (size_t k = 0; k < book->count; ++k) {
        const trial *t = &book->trials[k];
        if (access(t->path, F_OK) != 0) continue; /* gone: forget it */
        const elf_identity *f = &t->file;
        fprintf(out,
                "%d\t%" PRIu64 "\t%" PRIu64 "\t%" PRIu64 "\t%" PRId64 "\t%" PRId64 "\t%" PRId64
                "\t%" PRId64 "\t%s\t%s\n",
                (int)t->code, f->device, f->inode, f->size, f->modified_s, f->modified_ns,
                f->changed_s, f->changed_ns, t->path, t->text);
    }
    return fflush(out) == 0 && !ferror(out);
}

/* The folder of the book, and the one it is in, may be missing. */
static void make_folders(const char *file)
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s", file) >= (int)sizeof path) return;
    char *last = strrchr(path, '/');
    *last = '\0';
    char *before = strrchr(path, '/');
    *before = '\0';
    mkdir(path, 0700);
    *before = '/';
    mkdir(path, 0700);
}

/* A file of its own beside the book, then renamed over it: readers see one book or the other. */
static void write_back(const trial_book *book)
{
    char *draft = NULL;
    make_folders(book->file);
    if (asprintf(&draft, "%s.XXXXXX", book->file) < 0) return;
    const int fd = mkstemp(draft);
    FILE *out = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (out != NULL) {
        const bool good = write_all(book, out);
        if (fclose(out) != 0 || !good || rename(draft, book->file) != 0) unlink(draft);
    } else if (fd >= 0) {
        close(fd);
        unlink(draft);
    }
    free(draft);
}

void trial_book_close(trial_book *book)
{
    if (book == NULL) return;
    if (book->changed && book->file != NULL) write_back(book);
    for (size_t k = 0; k < book->count; ++k) trial_clear(&book->trials[k]);
    free(book->trials);
    free(book->file);
    free(book);
}
