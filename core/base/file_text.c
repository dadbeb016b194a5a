/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/file_text.h"
#include "core/common/array.h"
#include "core/common/system_error.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

#define PIECE ((size_t)1 << 16) /* bytes asked for at once */

static imp_code fail(const char *path, imp_error *error)
{
    return error_set(error, IMP_ERROR_FILE, "%s: cannot be read: %s", path,
                     system_error_text(errno));
}

static imp_code read_all(int fd, const char *path, char **text, size_t *length, imp_error *error)
{
    size_t capacity = 0;
    for (;;) {
        char *grown = array_reserve(*text, *length + PIECE, &capacity, 1);
        if (grown == NULL) return error_set_memory(error);
        *text = grown;
        ssize_t n = read(fd, *text + *length, PIECE);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return fail(path, error);
        if (n == 0) break;
        *length += (size_t)n;
        if (*length > FILE_TEXT_MAX)
            return error_set(error, IMP_ERROR_FILE, "%s: is longer than %zu bytes", path,
                             FILE_TEXT_MAX);
    }
    (*text)[*length] = '\0';
    return IMP_SUCCESS;
}

imp_code file_text_read(const char *path, char **text, size_t *length, imp_error *error)
{
    *text = NULL;
    *length = 0;
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (fd < 0) return fail(path, error);
    imp_code code = read_all(fd, path, text, length, error);
    close(fd);
    if (code == IMP_SUCCESS) return code;
    free(*text);
    *text = NULL;
    return code;
}
