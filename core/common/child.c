/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/common/child.h"
#include "core/common/child_process.h"
#include "core/common/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

void *child_memory(size_t size)
{
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory != MAP_FAILED ? memory : NULL;
}

void child_memory_free(void *memory, size_t size)
{
    if (memory != NULL) munmap(memory, size);
}

/* True if a byte came: the work is done. False on end of file or when time is up. */
static bool wait_for_byte(int fd, double deadline, bool *late)
{
    for (;;) {
        const double left = deadline - clock_seconds();
        struct pollfd watched = {.fd = fd, .events = POLLIN};
        const int ready = poll(&watched, 1, left > 0 ? (int)(left * 1e3) + 1 : 0);
        if (ready < 0 && errno == EINTR) continue;
        *late = ready == 0;
        if (ready == 0 && clock_seconds() < deadline) continue;
        if (ready <= 0) return false;
        char byte;
        return read(fd, &byte, 1) == 1;
    }
}

static child_fate fate_of(int status, bool done, bool late)
{
    if (done) return (child_fate){CHILD_DONE, 0};
    if (late) return (child_fate){CHILD_LATE, 0};
    if (status != -1 && WIFSIGNALED(status)) return (child_fate){CHILD_KILLED, WTERMSIG(status)};
    return (child_fate){CHILD_EXITED, status != -1 && WIFEXITED(status) ? WEXITSTATUS(status) : -1};
}

/* Whether it has been stopped: then it had no time to finish. */
static int stopping_signal(pid_t child)
{
    siginfo_t state = {.si_pid = 0};
    const int known = waitid(P_PID, (id_t)child, &state, WSTOPPED | WNOHANG | WNOWAIT);
    return known == 0 && state.si_pid != 0 ? state.si_status : 0;
}

/* Whatever the child has started ends with it. */
static child_fate watch(pid_t child, int fd, double seconds)
{
    bool late = false;
    int status = 0;
    const bool done = wait_for_byte(fd, clock_seconds() + seconds, &late);
    const int stopped = late ? stopping_signal(child) : 0;
    if (done || late) kill(-child, SIGKILL);
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR) {
            status = -1;
            break;
        }
    return stopped != 0 ? (child_fate){CHILD_STOPPED, stopped} : fate_of(status, done, late);
}

/* `errors`: standard error of the child, or -1. */
static child_fate run(child_work *work, void *result, const void *task, double seconds, int errors)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return (child_fate){CHILD_NOT_RUN, errno};
    const pid_t child = fork();
    if (child == 0) {
        child_process_detach(ends[1], errors);
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        work(result, task);
        _exit(write(CHILD_DESCRIPTOR, "", 1) == 1 ? 0 : 1);
    }
    const int error = errno;
    close(ends[1]);
    if (child > 0) setpgid(child, child); /* whoever of the two is first */
    const child_fate fate =
        child > 0 ? watch(child, ends[0], seconds) : (child_fate){CHILD_NOT_RUN, error};
    close(ends[0]);
    return fate;
}

child_fate child_run(child_work *work, void *result, const void *task, double seconds)
{
    return run(work, result, task, seconds, -1);
}

child_fate child_run_heard(child_work *work, void *result, const void *task, double seconds,
                           char *said, size_t size)
{
    int ends[2];
    size_t length = 0;
    said[0] = '\0';
    if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) return child_run(work, result, task, seconds);
    const child_fate fate = run(work, result, task, seconds, ends[1]);
    close(ends[1]);
    while (length + 1 < size) {
        const ssize_t got = read(ends[0], said + length, size - 1 - length);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        length += (size_t)got;
    }
    said[length] = '\0';
    close(ends[0]);
    return fate;
}
