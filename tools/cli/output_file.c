/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/output_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/file_lock.h"
#include "tools/cli/output.h"
#include "tools/cli/standard_output.h"

/* Unlinks the draft while it is locked, so that the name cannot be another run's. */
static void forget(output_file *out)
{
    if (out->descriptor >= 0 && out->draft != NULL) unlink(out->draft);
    if (out->file != NULL && out->file != stdout)
        fclose(out->file);
    else if (out->descriptor >= 0)
        close(out->descriptor);
    free(out->draft);
    free(out->target);
    free(out->path);
    *out = (output_file){.descriptor = -1};
}

static exit_status fail(output_file *out, int error)
{
    const exit_status status =
        complain(EXIT_DATA, out->verb, "%s: %s", out->path, system_error_text(error));
    forget(out);
    return status;
}

/* --- Writing ---------------------------------------------------------------------------------- */

/* Called by stdio, which keeps only the fact that a write failed, and which calls a write that is
 * cut short a failure: on a disk that fills up, the next write tells why. */
static ssize_t write_all(void *cookie, const char *text, size_t length)
{
    output_file *out = cookie;
    size_t done = 0;
    while (done < length) {
        const ssize_t n = write(out->descriptor, text + done, length - done);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && out->error == 0) out->error = errno;
        if (n < 0) break;
        done += (size_t)n;
    }
    return (ssize_t)done;
}

static int close_descriptor(void *cookie)
{
    const output_file *out = cookie;
    return close(out->descriptor);
}

/* Takes ownership of the descriptor; -1: it could not be opened, for errno's reason. */
static exit_status begin_file(output_file *out, int fd)
{
    const cookie_io_functions_t functions = {.write = write_all, .close = close_descriptor};
    out->descriptor = fd;
    if (fd < 0) return fail(out, errno);
    out->file = fopencookie(out, "w", functions);
    return out->file != NULL ? EXIT_ANSWERED : fail(out, ENOMEM);
}

/* --- Drafts ----------------------------------------------------------------------------------- */

/* Gives the draft the mode of the file that it replaces and, if root replaces it, its owner. */
static void copy_mode(int fd, const struct stat *there)
{
    const int mode = fchmod(fd, there->st_mode & 0777);
    const int owner = fchown(fd, there->st_uid, there->st_gid);
    (void)mode, (void)owner;
}

/* Takes over target->path. */
static exit_status begin_draft(output_file *out, const output_target *target)
{
    int fd;
    struct stat is;
    out->target = target->path;
    if (target->kind == OUTPUT_FILE && access(out->target, W_OK) != 0) return fail(out, errno);
    if (asprintf(&out->draft, "%s.part", out->target) < 0) {
        out->draft = NULL;
        return fail(out, ENOMEM);
    }
    const file_lock lock = {.file = out->draft, .output = out->path, .verb = out->verb};
    const exit_status locked = file_lock_open(&lock, &fd, &is);
    if (locked != EXIT_ANSWERED) {
        forget(out);
        return locked;
    }
    const exit_status begun = begin_file(out, fd);
    if (begun != EXIT_ANSWERED) return begun;
    if (is.st_size > 0 && ftruncate(fd, 0) != 0) return fail(out, errno);
    if (target->kind == OUTPUT_FILE) copy_mode(fd, &target->there);
    return EXIT_ANSWERED;
}

/* --- Both ------------------------------------------------------------------------------------- */

/* Descriptors of our own are closed on exec; those that the caller handed down are not. */
static int copy_descriptor(int number)
{
    const int flags = fcntl(number, F_GETFD);
    if (flags >= 0 && (flags & FD_CLOEXEC) == 0)
        return fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    errno = EBADF;
    return -1;
}

exit_status output_file_begin(output_file *out, const char *path, const char *verb)
{
    *out = (output_file){.descriptor = -1, .path = strdup(path), .verb = verb};
    if (out->path == NULL) return complain_of_memory(verb);
    const output_target target = output_target_of(path);
    switch (target.kind) {
    case OUTPUT_STANDARD:
        out->file = stdout;
        return EXIT_ANSWERED;
    case OUTPUT_DESCRIPTOR:
        return begin_file(out, copy_descriptor(target.number));
    case OUTPUT_STREAM:
        return begin_file(out, open(path, O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC));
    case OUTPUT_NEW:
    case OUTPUT_FILE:
        return begin_draft(out, &target);
    case OUTPUT_REFUSED:
        break;
    }
    return fail(out, errno);
}

static exit_status end_standard(output_file *out, bool keep)
{
    const char *verb = out->verb;
    forget(out);
    if (keep) return output_flush(verb);
    standard_output_discard();
    return EXIT_ANSWERED;
}

/* Renames the draft while it is locked, and thus before it is closed; fsync reports the errors that
 * closing would report. */
static bool put_in_place(const output_file *out)
{
    if (out->draft == NULL) return true;
    return fsync(out->descriptor) == 0 && rename(out->draft, out->target) == 0;
}

exit_status output_file_end(output_file *out, bool keep)
{
    if (out->file == stdout) return end_standard(out, keep);
    const bool written = fflush(out->file) == 0 && !ferror(out->file);
    if (!written) return fail(out, out->error != 0 ? out->error : EIO);
    if (keep && !put_in_place(out)) return fail(out, errno);
    if (keep) {
        free(out->draft);
        out->draft = NULL;
    }
    forget(out);
    return EXIT_ANSWERED;
}
