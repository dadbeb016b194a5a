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
#include <unistd.h>

/* One for the process, as stdout is. */
static struct {
    int descriptor;
    pid_t owner;
    bool is_terminal;
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

static bool write_out(void)
{
    const size_t used = output.used;
    output.used = 0;
    if (output.owner != getpid()) return true;
    if (output.error == 0 && !write_all(output.text, used)) output.error = errno;
    return output.error == 0;
}

bool standard_output_flush(void)
{
    const bool written = write_out();
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

/* What stdio hands over: with an unbuffered stream each call's text as a whole, at once. */
static ssize_t take(void *unused, const char *text, size_t length)
{
    (void)unused;
    if (output.owner != getpid()) return (ssize_t)length;
    if (imp_call_in_progress(NULL) != NULL)
        return write(STDERR_FILENO, text, length) >= 0 ? (ssize_t)length : 0;
    return collect(text, length) ? (ssize_t)length : 0;
}

/* With no descriptor left, plugins share descriptor 1. */
bool standard_output_prepare(void)
{
    const cookie_io_functions_t functions = {.write = take};
    FILE *stream = fopencookie(NULL, "w", functions);
    if (stream == NULL) return false;
    const int copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    output.descriptor = copy >= 0 ? copy : STDOUT_FILENO;
    output.owner = getpid();
    output.is_terminal = isatty(output.descriptor);
    if (copy >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
    setvbuf(stream, NULL, _IONBF, 0);
    stdout = stream;
    return true;
}

bool standard_output_replace(int descriptor)
{
    return dup3(descriptor, output.descriptor, O_CLOEXEC) == output.descriptor;
}

bool standard_output_close(void)
{
    const bool flushed = standard_output_flush();
    if (output.owner != getpid()) return flushed;
    return close(output.descriptor) == 0 && flushed;
}
