/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/program.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

static int start(const char *const *words, int stream, int to, pid_t *pid)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t usual;
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) return error;
    error = posix_spawnattr_init(&attributes);
    if (error == 0) {
        sigemptyset(&usual);
        sigaddset(&usual, SIGINT), sigaddset(&usual, SIGQUIT), sigaddset(&usual, SIGPIPE);
        sigaddset(&usual, SIGXFSZ);
        posix_spawnattr_setsigdefault(&attributes, &usual);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
        error = posix_spawn_file_actions_adddup2(&actions, to, stream);
        /* posix_spawnp writes no word, though its type would let it. */
        char *const *argv = (char *const *)(uintptr_t)words;
        if (error == 0) error = posix_spawnp(pid, words[0], &actions, &attributes, argv, environ);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/* Returns everything that is read until the other end is closed. */
static char *listen_to(int from, bool shown)
{
    char *said = NULL, some[4096];
    size_t length = 0;
    FILE *memory = open_memstream(&said, &length);
    for (ssize_t n; (n = read(from, some, sizeof some)) != 0;) {
        if (n < 0 && errno != EINTR) break;
        if (n < 0) continue;
        if (memory != NULL) fwrite(some, 1, (size_t)n, memory);
        if (shown) fwrite(some, 1, (size_t)n, stderr);
    }
    if (memory != NULL && fclose(memory) != 0) {
        free(said);
        said = NULL;
    }
    return said;
}

static int wait_for(pid_t pid)
{
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

static program_end run_with_pipe(const char *const *words, program_stream stream, bool shown,
                                 const int pipe[2])
{
    pid_t pid = -1;
    program_end end = {.error = start(words, (int)stream, pipe[1], &pid)};
    close(pipe[1]);
    if (end.error == 0) {
        end.said = listen_to(pipe[0], shown);
        end.status = wait_for(pid);
    }
    close(pipe[0]);
    return end;
}

program_end program_run(const char *const *words, program_stream stream, bool shown)
{
    struct sigaction ignore = {.sa_handler = SIG_IGN}, interrupt, quit;
    int pipe[2];
    if (pipe2(pipe, O_CLOEXEC) != 0) return (program_end){.error = errno};
    sigaction(SIGINT, &ignore, &interrupt);
    sigaction(SIGQUIT, &ignore, &quit);
    const program_end end = run_with_pipe(words, stream, shown, pipe);
    sigaction(SIGINT, &interrupt, NULL);
    sigaction(SIGQUIT, &quit, NULL);
    return end;
}

char *program_find(const char *name)
{
    const char *path = getenv("PATH");
    while (path != NULL && *path != '\0') {
        const size_t length = strcspn(path, ":");
        char *file;
        if (asprintf(&file, "%.*s%s%s", (int)length, path, length > 0 ? "/" : "./", name) < 0)
            return NULL;
        if (access(file, X_OK) == 0) return file;
        free(file);
        path += length + (path[length] == ':');
    }
    return NULL;
}

char *program_beside(const char *name)
{
    char own[PATH_MAX], *file;
    const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    own[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(own, '/');
    if (slash == NULL) return program_find(name);
    *slash = '\0';
    if ((slash = strrchr(own, '/')) != NULL && strcmp(slash, "/.libs") == 0) *slash = '\0';
    if (asprintf(&file, "%s/%s", own, name) < 0) return NULL;
    if (access(file, X_OK) == 0) return file;
    free(file);
    return program_find(name);
}

bool program_words(char *text, const char **words, int *count, int most)
{
    char *rest = NULL;
    for (char *word = strtok_r(text, " \t\n", &rest); word != NULL;
         word = strtok_r(NULL, " \t\n", &rest)) {
        if (*count == most) return false;
        words[(*count)++] = word;
    }
    return true;
}
