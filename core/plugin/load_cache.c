/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/text.h"
#include "core/common/array.h"
#include "core/plugin/load_probe.h"
#include "core/plugin/open_file.h"

#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* The cache is text, one record a line, fields parted by tabs: code, device, inode, size, seconds
 * and nanoseconds of modification and of change, path, reason. Its first line names the version:
 * another one's cache is not read. */

typedef struct load_record {
    imp_code code;
    elf_identity file;
    char *path, *text;
} load_record;

struct load_cache {
    load_record *records;
    size_t count, capacity;
    char *file; /* NULL: not kept */
    bool changed;
};

/* More than anybody has; a longer file is not read, and of more records the oldest are
 * forgotten. */
enum { RECORDS_MAX = 4096, CACHE_BYTES_MAX = 1 << 23 };

#define FIRST_LINE "impinge trials 3 of " PACKAGE_VERSION "\n"

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

static char *cache_file(void)
{
    char *folder = cache_folder(), *file = NULL;
    if (folder != NULL && asprintf(&file, "%s/trials", folder) < 0) file = NULL;
    free(folder);
    return file;
}

static void record_clear(load_record *t)
{
    free(t->path);
    free(t->text);
}

static void forget_oldest(load_cache *cache)
{
    record_clear(&cache->records[0]);
    cache->count -= 1;
    memmove(cache->records, cache->records + 1, cache->count * sizeof *cache->records);
}

static bool add(load_cache *cache, load_record t)
{
    load_record *grown =
        array_reserve(cache->records, cache->count, &cache->capacity, sizeof *grown);
    if (grown != NULL) cache->records = grown;
    if (grown == NULL || t.path == NULL || t.text == NULL) {
        record_clear(&t);
        return false;
    }
    if (cache->count == RECORDS_MAX) forget_oldest(cache);
    cache->records[cache->count++] = t;
    return true;
}

/* A line that does not read as one is passed over: the file is tried again, that is all. False: no
 * memory. */
static bool read_line(load_cache *cache, char *line)
{
    load_record t = {0};
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
    return add(cache, t);
}

static bool read_lines(load_cache *cache, FILE *in)
{
    char *line = NULL;
    size_t size = 0;
    bool good = true;
    if (getline(&line, &size, in) > 0 && strcmp(line, FIRST_LINE) == 0)
        while (good && getline(&line, &size, in) > 0) good = read_line(cache, line);
    free(line);
    return good;
}

/* Only a regular file is read: a pipe or a device might block or never end. */
static FILE *open_cache(const char *file)
{
    struct stat facts;
    const int fd = open_file(file);
    const bool good = fd >= 0 && fstat(fd, &facts) == 0 && S_ISREG(facts.st_mode) &&
                      facts.st_size <= CACHE_BYTES_MAX;
    FILE *in = good ? fdopen(fd, "r") : NULL;
    if (in == NULL && fd >= 0) close(fd);
    return in;
}

load_cache *load_cache_read(void)
{
    load_cache *cache = calloc(1, sizeof *cache);
    if (cache == NULL) return NULL;
    cache->file = cache_file();
    FILE *in = cache->file != NULL ? open_cache(cache->file) : NULL;
    if (in == NULL) return cache;
    const bool good = read_lines(cache, in);
    fclose(in);
    if (good) return cache;
    load_cache_close(cache);
    return NULL;
}

static load_record *find(const load_cache *cache, const char *path)
{
    for (size_t k = 0; k < cache->count; ++k)
        if (strcmp(cache->records[k].path, path) == 0) return &cache->records[k];
    return NULL;
}

bool load_cache_find(const load_cache *cache, const char *path, const elf_probe *file,
                     imp_code *code, const char **text)
{
    const load_record *t = find(cache, path);
    if (t == NULL || !elf_identity_is_same(t->file, file->file)) return false;
    *code = t->code;
    *text = t->text;
    return true;
}

bool load_cache_has_passed(const load_cache *cache, const char *path)
{
    const load_record *t = find(cache, path);
    return t != NULL && t->code == IMP_SUCCESS && elf_identity_is_at(t->file, path);
}

bool load_cache_add(load_cache *cache, const char *path, const elf_probe *file, imp_code code,
                    const char *text)
{
    if (strpbrk(path, "\t\n") != NULL) return true; /* tried every time */
    load_record t = {code, file->file, strdup(path), strdup(text)};
    for (char *c = t.text; c != NULL && *c != '\0'; ++c)
        if (*c == '\n') *c = ' ';
    load_record *old = find(cache, path);
    if (old != NULL && t.path != NULL && t.text != NULL) {
        record_clear(old);
        *old = t;
    } else if (!add(cache, t)) {
        return false;
    }
    cache->changed = true;
    return true;
}

static bool write_all(const load_cache *cache, FILE *out)
{
    fputs(FIRST_LINE, out);
    for (size_t k = 0; k < cache->count; ++k) {
        const load_record *t = &cache->records[k];
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

/* The folder of the cache, and the one it is in, may be missing. */
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

/* A file of its own beside the cache, then renamed over it: readers see one cache or the other. */
static void write_file(const load_cache *cache)
{
    char *draft = NULL;
    make_folders(cache->file);
    if (asprintf(&draft, "%s.XXXXXX", cache->file) < 0) return;
    const int fd = mkostemp(draft, O_CLOEXEC);
    FILE *out = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (out != NULL) {
        const bool good = write_all(cache, out);
        if (fclose(out) != 0 || !good || rename(draft, cache->file) != 0) unlink(draft);
    } else if (fd >= 0) {
        close(fd);
        unlink(draft);
    }
    free(draft);
}

/* Beyond the limit of a file's size a write raises SIGXFSZ, which would end the host for the sake
 * of a cache. It is raised in this thread, so it is blocked here and removed. */
static void write_back(const load_cache *cache)
{
    sigset_t size, before, pending;
    const struct timespec at_once = {0, 0};
    sigemptyset(&size);
    sigaddset(&size, SIGXFSZ);
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, &size, &before);
    write_file(cache);
    if (!sigismember(&pending, SIGXFSZ)) sigtimedwait(&size, NULL, &at_once);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
}

void load_cache_close(load_cache *cache)
{
    if (cache == NULL) return;
    if (cache->changed && cache->file != NULL) write_back(cache);
    for (size_t k = 0; k < cache->count; ++k) record_clear(&cache->records[k]);
    free(cache->records);
    free(cache->file);
    free(cache);
}
