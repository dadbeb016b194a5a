/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TESTS_SUPPORT_SANDBOX_H
#define TESTS_SUPPORT_SANDBOX_H

#include <check.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A directory of one's own, and the test plugins to put into it. */

typedef struct sandbox {
    char path[200];
} sandbox;

typedef struct sandbox_path {
    char at[500];
} sandbox_path;

typedef struct sandbox_bytes {
    unsigned char *at;
    size_t length;
} sandbox_bytes;

static inline sandbox sandbox_new(void)
{
    sandbox box;
    const char *tmp = getenv("TMPDIR");
    /* mkdtemp wants six letters X at the end, to change them */
    snprintf(box.path, sizeof box.path, "%s/impinge-%06d", tmp != NULL && *tmp ? tmp : P_tmpdir, 0);
    memset(box.path + strlen(box.path) - 6, 'X', 6);
    ck_assert_ptr_nonnull(mkdtemp(box.path));
    return box;
}

static inline sandbox_path sandbox_file(const sandbox *box, const char *name)
{
    sandbox_path path;
    snprintf(path.at, sizeof path.at, "%s/%s", box->path, name);
    return path;
}

static inline void sandbox_remove(const sandbox *box)
{
    DIR *stream = opendir(box->path);
    ck_assert_ptr_nonnull(stream);
    for (struct dirent *entry; (entry = readdir(stream)) != NULL;) {
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0) continue;
        ck_assert_int_eq(remove(sandbox_file(box, entry->d_name).at), 0);
    }
    closedir(stream);
    ck_assert_int_eq(rmdir(box->path), 0);
}

/* Where `make check` has built tests/plugins/NAME.c. */
static inline sandbox_path sandbox_plugin(const char *name)
{
    sandbox_path path;
    const char *build = getenv("top_builddir");
    snprintf(path.at, sizeof path.at, "%s/tests/plugins/.libs/%s.so", build != NULL ? build : ".",
             name);
    return path;
}

static inline void sandbox_link(const sandbox *box, const char *plugin, const char *name)
{
    char *target = realpath(sandbox_plugin(plugin).at, NULL);
    ck_assert_msg(target != NULL, "%s is not built", sandbox_plugin(plugin).at);
    ck_assert_int_eq(symlink(target, sandbox_file(box, name).at), 0);
    free(target);
}

static inline void sandbox_write(const sandbox *box, const char *name, const void *bytes,
                                 size_t length)
{
    FILE *file = fopen(sandbox_file(box, name).at, "wb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fwrite(bytes, 1, length, file), length);
    ck_assert_int_eq(fclose(file), 0);
}

static inline sandbox_bytes sandbox_read(const char *path)
{
    struct stat facts;
    ck_assert_msg(stat(path, &facts) == 0, "%s cannot be read", path);
    sandbox_bytes bytes = {malloc((size_t)facts.st_size + 1), (size_t)facts.st_size};
    FILE *file = fopen(path, "rb");
    ck_assert_ptr_nonnull(file);
    ck_assert_uint_eq(fread(bytes.at, 1, bytes.length, file), bytes.length);
    fclose(file);
    return bytes;
}

#endif
