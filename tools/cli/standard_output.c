/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/standard_output.h"

#include <errno.h>
#include <fcntl.h>
#include <impinge/impinge.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Global, like stdout. */
static struct {
    int descriptor;
    struct stat file; /* the file of the descriptor: a plugin may close it, or open another */
    pid_t owner;
    bool is_terminal, is_replaced;
    int error; /* errno of a write that failed and was not reported yet; 0: none */
    size_t used;
    char text[1 << 14];
} output;

static bool wait_until_writable(void)
{
    struct pollfd end = {.fd = output.descriptor, .events = POLLOUT};
    return poll(&end, 1, -1) >= 0 || errno == EINTR;
}

static bool write_all(const char *text, size_t length)
{
    while (length > 0) {
        const ssize_t n = write(output.descriptor, text, length);
        if (n >= 0) {
            text += n;
            length -= (size_t)n;
        } else if (errno != EINTR && !(errno == EAGAIN && wait_until_writable())) {
            return false;
        }
    }
    return true;
}

/* Whether the descriptor is still ours; errno EBADF if not. */
static bool is_still_ours(void)
{
    struct stat now;
    if (fstat(output.descriptor, &now) != 0) return false;
    errno = EBADF;
    return now.st_dev == output.file.st_dev && now.st_ino == output.file.st_ino;
}

static bool write_out(void)
{
    const size_t used = output.used;
    output.used = 0;
    if (output.owner != getpid() || used == 0) return output.error == 0;
    if (output.error == 0 && !(is_still_ours() && write_all(output.text, used)))
        output.error = errno;
    return output.error == 0;
}

/* Flushes stdio's buffer first, which a plugin may have set. */
bool standard_output_flush(void)
{
    const bool passed_on = fflush(stdout) == 0;
    const bool written = write_out() && passed_on;
    errno = output.error;
    output.error = 0;
    return written;
}

bool standard_output_is_terminal(void) { return output.is_terminal; }

void standard_output_discard(void) { output.used = 0; }

static bool collect(const char *text, size_t length)
{
    const bool line = output.is_terminal && memchr(text, '\n', length) != NULL;
    while (length > 0) {
        const size_t room = sizeof output.text - output.used;
        const size_t part = length < room ? length : room;
        memcpy(output.text + output.used, text, part);
        output.used += part;
        text += part;
        length -= part;
        if (output.used == sizeof output.text && !write_out()) return false;
    }
    return !line || write_out();
}

/* Receives text from stdio: each call's whole text at once, since the stream is unbuffered. */
static ssize_t take(void *unused, const char *text, size_t length)
{
    (void)unused;
    if (output.owner != getpid()) return (ssize_t)length;
    if (imp_call_in_progress(NULL) != NULL)
        return write(STDERR_FILENO, text, length) >= 0 ? (ssize_t)length : 0;
    return collect(text, length) ? (ssize_t)length : 0;
}

static bool open_stream(void);

/* Only a plugin closes the stream (fclose, freopen): then there is a new one, and what the plugin
 * prints into the old one is lost. Without memory for a new stream our text is lost, which is
 * reported. */
static int reopen(void *unused)
{
    (void)unused;
    if (!open_stream()) output.error = ENOMEM;
    return 0;
}

static bool open_stream(void)
{
    const cookie_io_functions_t functions = {.write = take, .close = reopen};
    FILE *stream = fopencookie(NULL, "w", functions);
    if (stream == NULL) return false;
    setvbuf(stream, NULL, _IONBF, 0);
    stdout = stream;
    return true;
}

/* If no descriptor is left, plugins share descriptor 1. */
bool standard_output_prepare(void)
{
    const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    output.descriptor = copy >= 0 ? copy : STDOUT_FILENO;
    output.owner = getpid();
    output.is_terminal = isatty(output.descriptor);
    (void)fstat(output.descriptor, &output.file);
    if (copy >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
    return open_stream();
}

bool standard_output_replace(int descriptor)
{
    output.is_replaced = dup3(descriptor, output.descriptor, O_CLOEXEC) == output.descriptor &&
                         fstat(output.descriptor, &output.file) == 0;
    return output.is_replaced;
}

bool standard_output_is_replaced(void) { return output.is_replaced; }

void standard_output_write_at_crash(const char *text, size_t length)
{
    output.used = 0;
    if (!output.is_replaced && is_still_ours()) (void)write_all(text, length);
}

bool standard_output_close(void)
{
    const bool flushed = standard_output_flush();
    if (output.owner != getpid()) return flushed;
    return close(output.descriptor) == 0 && flushed;
}
