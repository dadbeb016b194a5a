/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "plugin_trial.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { DEADLINE_MS = 5000 };

typedef struct outcome {
    imp_code code;
    imp_error error;
} outcome;

/* --- The child -------------------------------------------------------------------------- */

/* Nothing of the plugin's reaches the terminal, and a crash leaves no core file. */
static void go_quiet(void)
{
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    const int null = open("/dev/null", O_RDWR);
    for (int fd = 0; null >= 0 && fd <= 2; ++fd) dup2(null, fd);
    const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGALRM};
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; ++k) signal(fatal[k], SIG_DFL);
}

static void child(int to_parent, const char *path, imp_code (*open)(const char *, imp_error *))
{
    outcome result;
    memset(&result, 0, sizeof result);
    go_quiet();
    result.code = open(path, &result.error);
    /* smaller than PIPE_BUF: written at once or not at all */
    _exit(write(to_parent, &result, sizeof result) == (ssize_t)sizeof result ? 0 : 1);
}

/* --- The parent ---------------------------------------------------------------------------- */

static long long now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000LL + t.tv_nsec / 1000000;
}

typedef enum reading { READ_WHOLE, READ_ENDED, READ_LATE } reading;

static reading read_outcome(int from_child, outcome *result)
{
    const long long end = now_ms() + DEADLINE_MS;
    for (;;) {
        const long long left = end - now_ms();
        struct pollfd wait = {.fd = from_child, .events = POLLIN};
        const int ready = poll(&wait, 1, left > 0 ? (int)left : 0);
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return READ_LATE;
        const ssize_t got = read(from_child, result, sizeof *result);
        if (got < 0 && errno == EINTR) continue;
        return got == (ssize_t)sizeof *result ? READ_WHOLE : READ_ENDED;
    }
}

/* Its end, as a wait status; -1 where the host has its children reaped by someone else. */
static int bury(pid_t pid)
{
    int status;
    while (waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) return -1;
    return status;
}

static imp_code tell_end(int status, imp_error *error)
{
    if (status != -1 && WIFSIGNALED(status))
        return error_set(
            error, IMP_ERROR_PLUGIN,
            "trial: loading it crashes: signal %d (%s); look at its constructors and get_factory, "
            "which run then",
            WTERMSIG(status), strsignal(WTERMSIG(status)));
    if (status != -1 && WIFEXITED(status))
        return error_set(
            error, IMP_ERROR_PLUGIN,
            "trial: loading it ends the process with status %d; a plugin must not exit: answer "
            "IMP_INTERNAL from create instead",
            WEXITSTATUS(status));
    return error_set(error, IMP_ERROR_PLUGIN,
                     "trial: loading it ends the process; a plugin must not");
}

imp_code plugin_trial_run(const char *path, imp_code (*open)(const char *path, imp_error *error),
                          imp_error *error)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return error_set_memory(error);
    const pid_t pid = fork();
    if (pid == 0) child(ends[1], path, open);
    close(ends[1]);
    if (pid < 0) {
        close(ends[0]);
        return error_set_memory(error);
    }
    outcome result;
    const reading how = read_outcome(ends[0], &result);
    close(ends[0]);
    if (how != READ_ENDED) kill(pid, SIGKILL); /* its work is done, or it never will be */
    const int status = bury(pid);
    if (how == READ_LATE)
        return error_set(
            error, IMP_ERROR_PLUGIN,
            "trial: loading it does not finish within %d s; look at its constructors and "
            "get_factory, which run then",
            DEADLINE_MS / 1000);
    if (how == READ_ENDED) return tell_end(status, error);
    if (result.code != IMP_SUCCESS && error != NULL) *error = result.error;
    return result.code;
}
