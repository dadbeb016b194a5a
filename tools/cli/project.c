/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/project.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/input.h"

/* --- Texts ------------------------------------------------------------------------------------ */

/* Returns the row whose @word@ is at the beginning of the text, or NULL. */
static const project_word *word_at(const char *text, const project_word *words)
{
    for (; words->word != NULL; ++words) {
        const size_t length = strlen(words->word);
        if (strncmp(text + 1, words->word, length) == 0 && text[length + 1] == '@') return words;
    }
    return NULL;
}

/* Returns the text with its words replaced; any other '@' is kept. NULL: no memory. */
static char *expanded(const char *text, const project_word *words)
{
    char *result = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&result, &size);
    if (memory == NULL) return NULL;
    while (*text != '\0') {
        const project_word *word = *text == '@' ? word_at(text, words) : NULL;
        if (word != NULL)
            fputs(word->value, memory);
        else
            putc(*text, memory);
        text += word != NULL ? strlen(word->word) + 2 : 1;
    }
    if (fclose(memory) == 0) return result;
    free(result);
    return NULL;
}

static char *read_all(const char *path, const char *verb)
{
    input_text t = {0};
    FILE *file = input_open(path, verb);
    if (file == NULL) return NULL;
    const bool read = input_read(file, path, verb, &t);
    input_close(file);
    char *ended = read ? strndup(t.text, t.length) : NULL;
    if (read && ended == NULL) complain_of_memory(verb);
    free(t.text);
    return ended;
}

/* Returns the template's text for this project; NULL: it complained. */
static char *text_of(const char *template, const project_word *words, const char *verb)
{
    char name[256];
    snprintf(name, sizeof name, "template/%s", template);
    char *path = input_package_file(name, verb);
    char *raw = path != NULL ? read_all(path, verb) : NULL;
    char *text = raw != NULL ? expanded(raw, words) : NULL;
    if (raw != NULL && text == NULL) complain_of_memory(verb);
    free(raw);
    free(path);
    return text;
}

/* --- The folder ------------------------------------------------------------------------------- */

static bool is_empty(DIR *directory)
{
    for (const struct dirent *entry; (entry = readdir(directory)) != NULL;)
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) return false;
    return true;
}

static exit_status open_empty(const char *folder, int *at, const char *verb)
{
    DIR *directory = opendir(folder);
    if (directory == NULL)
        return complain(EXIT_DATA, verb, "%s: %s", folder, system_error_text(errno));
    const bool empty = is_empty(directory);
    *at = empty ? fcntl(dirfd(directory), F_DUPFD_CLOEXEC, 3) : -1;
    closedir(directory);
    if (empty && *at >= 0) return EXIT_ANSWERED;
    return complain(EXIT_DATA, verb, "%s: %s", folder,
                    empty ? system_error_text(errno) : "the folder is not empty; name a new one");
}

/* Makes the folder if need be and opens it; complains if it is not empty. */
static exit_status open_folder(const char *folder, bool *made, int *at, const char *verb)
{
    *made = mkdir(folder, 0777) == 0;
    if (!*made && errno != EEXIST)
        return complain(EXIT_DATA, verb, "%s: %s", folder, system_error_text(errno));
    const exit_status status = open_empty(folder, at, verb);
    if (status != EXIT_ANSWERED && *made) rmdir(folder);
    return status;
}

/* --- The files -------------------------------------------------------------------------------- */

/* Writes the part of a path in the project up to its k-th slash; false: it has fewer. */
static bool folder_of(const char *path, int k, char folder[64])
{
    const char *slash = strchr(path, '/');
    while (slash != NULL && k-- > 0) slash = strchr(slash + 1, '/');
    snprintf(folder, 64, "%.*s", slash != NULL ? (int)(slash - path) : 0, path);
    return slash != NULL;
}

static bool write_text(int at, const project_file *file, const char *text)
{
    char folder[64];
    for (int k = 0; folder_of(file->path, k, folder); ++k)
        if (mkdirat(at, folder, 0777) != 0 && errno != EEXIST) return false;
    const int fd = openat(at, file->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
                          file->executable ? 0777 : 0666);
    FILE *stream = fd >= 0 ? fdopen(fd, "w") : NULL;
    if (stream == NULL && fd >= 0) close(fd);
    if (stream == NULL) return false;
    const bool written = fputs(text, stream) >= 0;
    return fclose(stream) == 0 && written;
}

enum { FOLDERS_DEEP = 4 };

/* Removes the first `count` files that write_text wrote; the folder was empty before. */
static void remove_files(int at, const project_file *files, size_t count)
{
    char folder[64];
    for (size_t i = 0; i < count; ++i) unlinkat(at, files[i].path, 0);
    for (int k = FOLDERS_DEEP - 1; k >= 0; --k)
        for (size_t i = 0; i < count; ++i)
            if (folder_of(files[i].path, k, folder)) unlinkat(at, folder, AT_REMOVEDIR);
}

static exit_status write_files(const char *folder, const project_file *files, char *const *texts,
                               size_t count, const char *verb)
{
    bool made;
    int at = -1;
    exit_status status = open_folder(folder, &made, &at, verb);
    if (status != EXIT_ANSWERED) return status;
    for (size_t i = 0; i < count && status == EXIT_ANSWERED; ++i)
        if (!write_text(at, &files[i], texts[i]))
            status = complain(EXIT_DATA, verb, "%s/%s: %s", folder, files[i].path,
                              system_error_text(errno));
    if (status != EXIT_ANSWERED) remove_files(at, files, count);
    close(at);
    if (status != EXIT_ANSWERED && made) rmdir(folder);
    return status;
}

/* Makes all texts before it writes the first file. */
exit_status project_write(const char *folder, const project_file *files, const project_word *words,
                          const char *verb)
{
    size_t count = 0, known = 0;
    while (files[count].template != NULL) ++count;
    char **texts = calloc(count + 1, sizeof *texts);
    if (texts == NULL) return complain_of_memory(verb);
    while (known < count && (texts[known] = text_of(files[known].template, words, verb)) != NULL)
        ++known;
    const exit_status status =
        known == count ? write_files(folder, files, texts, count, verb) : EXIT_DATA;
    for (size_t i = 0; i < known; ++i) free(texts[i]);
    free(texts);
    return status;
}
