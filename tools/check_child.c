/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "check_child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

void *child_memory(size_t size)
{
    void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory != MAP_FAILED ? memory : NULL;
}

void child_memory_free(void *memory, size_t size)
{
    if (memory != NULL) munmap(memory, size);
}

/* Nothing the plugin prints mixes with our output, a crash is a crash and leaves no core file, and
 * the child does not outlive us. */
static void prepare_child(void)
{
    static const int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPIPE};
    for (size_t k = 0; k < sizeof crashes / sizeof *crashes; ++k) signal(crashes[k], SIG_DFL);
    const struct rlimit none = {0, 0};
    const int nowhere = open("/dev/null", O_RDWR);
    for (int fd = 0; fd <= 2 && nowhere >= 0; ++fd) dup2(nowhere, fd);
    setrlimit(RLIMIT_CORE, &none);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* True if a byte came: the work is done. False on end of file or when time is up. */
static bool wait_for_byte(int fd, double deadline, bool *late)
{
    for (;;) {
        const double left = deadline - now();
        struct pollfd watched = {.fd = fd, .events = POLLIN};
        const int ready = poll(&watched, 1, left > 0 ? (int)(left * 1e3) + 1 : 0);
        if (ready < 0 && errno == EINTR) continue;
        *late = ready == 0;
        if (ready == 0 && now() < deadline) continue;
        if (ready <= 0) return false;
        char byte;
        return read(fd, &byte, 1) == 1;
    }
}

static child_fate fate_of(int status, bool done, bool late)
{
    if (done) return (child_fate){CHILD_DONE, 0};
    if (late) return (child_fate){CHILD_LATE, 0};
    if (WIFSIGNALED(status)) return (child_fate){CHILD_KILLED, WTERMSIG(status)};
    return (child_fate){CHILD_EXITED, WEXITSTATUS(status)};
}

static child_fate watch(pid_t child, int fd, double seconds)
{
    bool late = false;
    int status = 0;
    const bool done = wait_for_byte(fd, now() + seconds, &late);
    if (done || late) kill(child, SIGKILL);
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    return fate_of(status, done, late);
}

child_fate child_run(child_work *work, void *result, const void *task, double seconds)
{
    int ends[2];
    fflush(stdout);
    if (pipe(ends) != 0) return (child_fate){CHILD_NOT_RUN, errno};
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        prepare_child();
        work(result, task);
        _exit(write(ends[1], "", 1) == 1 ? 0 : 1);
    }
    const int error = errno;
    close(ends[1]);
    const child_fate fate =
        child > 0 ? watch(child, ends[0], seconds) : (child_fate){CHILD_NOT_RUN, error};
    close(ends[0]);
    return fate;
}

fate_text child_fate_text(child_fate fate, double seconds)
{
    fate_text t = {"done"};
    switch (fate.end) {
    case CHILD_DONE:
        break;
    case CHILD_KILLED:
        snprintf(t.text, sizeof t.text, "crashed (%s)", strsignal(fate.number));
        break;
    case CHILD_EXITED:
        snprintf(t.text, sizeof t.text, "ended the process (exit status %d)", fate.number);
        break;
    case CHILD_LATE:
        snprintf(t.text, sizeof t.text, "did not come back within %g s", seconds);
        break;
    case CHILD_NOT_RUN:
        snprintf(t.text, sizeof t.text, "no process to run it in: %s", strerror(fate.number));
        break;
    }
    return t;
}
