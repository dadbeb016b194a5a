/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/system_error.h"
#include "tools/cli/output_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static exit_status fail(output_file *out, int error)
{
    const exit_status status =
        complain(EXIT_DATA, out->verb, "%s: %s", out->path, system_error_text(error));
    if (out->draft != NULL) unlink(out->draft);
    free(out->draft);
    free(out->path);
    *out = (output_file){0};
    return status;
}

/* As the umask wants a new file; mkstemp makes it private. */
static int make_draft(char *draft)
{
    const int fd = mkstemp(draft);
    const mode_t mask = umask(0);
    umask(mask);
    if (fd >= 0) (void)fchmod(fd, 0666 & ~mask);
    return fd;
}

exit_status output_file_begin(output_file *out, const char *path, const char *verb)
{
    struct stat there;
    *out = (output_file){.path = strdup(path), .verb = verb};
    if (out->path == NULL) return complain_of_memory(verb);
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode))
        return fail(out, S_ISDIR(there.st_mode) ? EISDIR : EEXIST);
    if (asprintf(&out->draft, "%s.XXXXXX", path) < 0) {
        out->draft = NULL;
        return fail(out, ENOMEM);
    }
    const int fd = make_draft(out->draft);
    if (fd < 0) return fail(out, errno);
    out->file = fdopen(fd, "w");
    if (out->file != NULL) return EXIT_ANSWERED;
    const int error = errno;
    close(fd);
    return fail(out, error);
}

exit_status output_file_end(output_file *out, bool keep)
{
    errno = EIO; /* where an earlier write failed, its own reason is gone */
    const bool good = !ferror(out->file) && fflush(out->file) == 0;
    const int error = errno;
    const bool closed = fclose(out->file) == 0;
    if (keep && (!good || !closed)) return fail(out, good ? errno : error);
    if (keep && rename(out->draft, out->path) != 0) return fail(out, errno);
    if (!keep) unlink(out->draft);
    free(out->draft);
    free(out->path);
    *out = (output_file){0};
    return EXIT_ANSWERED;
}
