/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/file_lock.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

#include "core/common/system_error.h"

static exit_status fail(const file_lock *lock)
{
    return complain(EXIT_DATA, lock->verb, "%s: %s", lock->output, system_error_text(errno));
}

static exit_status complain_of_trap(const file_lock *lock)
{
    return complain(EXIT_DATA, lock->verb, "%s: is in the way, and not a file of ours; remove it",
                    lock->file);
}

static bool is_held(int error) { return error == EACCES || error == EAGAIN; }

static bool has_no_locks(int error)
{
    return error == ENOLCK || error == ENOSYS || error == EINVAL || error == EOPNOTSUPP;
}

static exit_status take(const file_lock *lock, int fd)
{
    const struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    for (;;) {
        struct flock found = all;
        if (fcntl(fd, F_SETLK, &found) == 0 || has_no_locks(errno)) return EXIT_ANSWERED;
        if (!is_held(errno) || fcntl(fd, F_GETLK, &found) != 0) return fail(lock);
        if (found.l_type != F_UNLCK) /* else it was released between the two calls */
            return complain(EXIT_DATA, lock->verb,
                            "%s: process %ld is writing it; wait for its end, or name another file",
                            lock->output, (long)found.l_pid);
    }
}

/* Whether the open file has that name still: who had it locked before us may have renamed or
 * removed it. */
static bool has_name(const struct stat *is, const char *name)
{
    struct stat named;
    return lstat(name, &named) == 0 && named.st_dev == is->st_dev && named.st_ino == is->st_ino;
}

/* Checks a lock file that an earlier run left; one that another user may have planted is
 * refused. */
static exit_status check(const file_lock *lock, const struct stat *is)
{
    if (S_ISREG(is->st_mode) && is->st_nlink == 1 && is->st_uid == geteuid()) return EXIT_ANSWERED;
    return complain_of_trap(lock);
}

exit_status file_lock_open(const file_lock *lock, int *fd, struct stat *is)
{
    const int how = O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;
    for (;;) {
        *fd = open(lock->file, how, 0666);
        if (*fd < 0) return errno == ELOOP ? complain_of_trap(lock) : fail(lock);
        exit_status status = fstat(*fd, is) == 0 ? check(lock, is) : fail(lock);
        if (status == EXIT_ANSWERED) status = take(lock, *fd);
        if (status == EXIT_ANSWERED && has_name(is, lock->file)) return EXIT_ANSWERED;
        close(*fd);
        *fd = -1;
        if (status != EXIT_ANSWERED) return status;
    }
}
