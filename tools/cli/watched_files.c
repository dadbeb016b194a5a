/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/watched_files.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/inotify.h>
#include <unistd.h>

#include "core/common/system_error.h"
#include "tools/cli/interrupt.h"

static exit_status watch_one(watched_files *w, const char *path, const char *verb)
{
    const char *slash = strrchr(path, '/');
    char folder[4096];
    snprintf(folder, sizeof folder, "%.*s", slash == NULL ? 1 : (int)(slash - path) + 1,
             slash == NULL ? "." : path);
    const int watch = inotify_add_watch(w->notices, folder, IN_CLOSE_WRITE | IN_MOVED_TO);
    if (watch < 0) return complain(EXIT_DATA, verb, "%s: %s", folder, system_error_text(errno));
    w->folder[w->count] = watch;
    w->name[w->count++] = slash != NULL ? slash + 1 : path;
    return EXIT_ANSWERED;
}

exit_status watched_files_begin(watched_files *w, const char *const *paths, size_t count,
                                const char *verb)
{
    exit_status status = EXIT_ANSWERED;
    *w = (watched_files){.notices = inotify_init1(IN_CLOEXEC | IN_NONBLOCK)};
    if (w->notices < 0)
        return complain(EXIT_DATA, verb, "files cannot be watched: %s", system_error_text(errno));
    for (size_t k = 0; k < count && k < WATCHED_MOST && status == EXIT_ANSWERED; ++k)
        status = watch_one(w, paths[k], verb);
    return status;
}

static bool is_watched(const watched_files *w, const struct inotify_event *event)
{
    for (size_t k = 0; k < w->count; ++k)
        if (event->wd == w->folder[k] && event->len > 0 && strcmp(event->name, w->name[k]) == 0)
            return true;
    return false;
}

/* Reads all notices that are there; true: one is of a watched file. */
static bool take_notices(const watched_files *w)
{
    _Alignas(struct inotify_event) char bytes[4096];
    bool any = false;
    for (ssize_t length; (length = read(w->notices, bytes, sizeof bytes)) > 0;) {
        for (ssize_t at = 0; at < length;) {
            const struct inotify_event *event = (const void *)(bytes + at);
            any = any || is_watched(w, event) || (event->mask & IN_Q_OVERFLOW) != 0;
            at += (ssize_t)(sizeof *event + event->len);
        }
    }
    return any;
}

/* Waits so many milliseconds for notices, -1: for ever. */
static int wait_for(const watched_files *w, int milliseconds)
{
    struct pollfd descriptor = {.fd = w->notices, .events = POLLIN};
    return poll(&descriptor, 1, milliseconds);
}

enum { QUIET = 100, LOOK_EVERY = 500 }; /* milliseconds: a change is over; looks for signals */

bool watched_files_wait(watched_files *w)
{
    bool changed = false;
    while (!interrupt_came()) {
        const int ready = wait_for(w, changed ? QUIET : LOOK_EVERY);
        if (ready < 0 && errno != EINTR) return false;
        if (ready == 0 && changed) return true;
        if (ready > 0 && take_notices(w)) changed = true;
    }
    return false;
}

void watched_files_end(watched_files *w)
{
    if (w->notices >= 0) close(w->notices);
    w->notices = -1;
}
