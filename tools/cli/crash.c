/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/crash.h"

#include <impinge/impinge.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "tools/cli/message.h"

/* The process that was prepared: its copies may end as they like. */
static pid_t prepared;

/* Only calls that are safe in a signal handler. */
static void say(const char *text)
{
    const ssize_t written = write(STDERR_FILENO, text, strlen(text));
    (void)written;
}

_Noreturn static void leave(int status)
{
    for (;;) syscall(SYS_exit_group, status);
}

/* Of a plugin that is being loaded or unloaded, `type` is the path. */
_Noreturn static void blame(const char *type, const char *callback, const char *what)
{
    say(type[0] == '/' ? "impinge: plugin '" : "impinge: type '");
    say(message_shown(type).text);
    say("' ");
    say(what);
    say(" in its ");
    say(callback);
    say(type[0] == '/' ? "; `impinge why FILE` loads it in a process of its own\n"
                       : "; `impinge check` shows more, --isolate runs it in another process\n");
    leave(EXIT_PLUGIN);
}

static void blame_if_in_call(const char *what)
{
    const char *callback, *type = imp_call_in_progress(&callback);
    if (type != NULL && prepared == getpid()) blame(type, callback, what);
}

static void on_crash(int number)
{
    blame_if_in_call("crashes");
    signal(number, SIG_DFL);
    raise(number);
}

/* --- Threads and their calls ------------------------------------------------------------------ */

/* Main and as many as --threads allows; the calls of any more would not be known. */
enum { THREADS_MAX = 1025 };

/* Where the call of each thread can be read; NULL: free. */
static const imp_call *_Atomic calls[THREADS_MAX];
static _Thread_local size_t own_call = THREADS_MAX;

/* Set when a handler begins to read them, for good: it ends the process. */
static atomic_bool calls_are_read;

static void enter_call(void)
{
    for (own_call = 0; own_call < THREADS_MAX; ++own_call) {
        const imp_call *free_place = NULL;
        if (atomic_compare_exchange_strong(&calls[own_call], &free_place, imp_call_of_thread()))
            return;
    }
}

/* A thread that ends takes its call along, so it waits where the handler may have found that. */
static void leave_call(void)
{
    if (own_call == THREADS_MAX) return;
    atomic_store(&calls[own_call], NULL);
    while (atomic_load(&calls_are_read)) pause();
}

static void say_interrupted(const char *type, const char *callback)
{
    say("impinge: interrupted in ");
    say(callback);
    say(type[0] == '/' ? " of plugin '" : " of type '");
    say(message_shown(type).text);
    say(type[0] == '/' ? "'\n" : "'; where a callback hangs, --isolate ends it after 5 s\n");
}

void crash_interrupted(int number)
{
    if (prepared == getpid()) atomic_store(&calls_are_read, true);
    for (size_t k = 0; k < THREADS_MAX && prepared == getpid(); ++k) {
        const imp_call *call = atomic_load(&calls[k]);
        const char *callback, *type = imp_call_read(call, &callback);
        if (type != NULL) say_interrupted(type, callback);
    }
    signal(number, SIG_DFL);
    raise(number);
}

static void on_exit_in_call(void) { blame_if_in_call("ends the process"); }
static void on_fork_in_call(void) { blame_if_in_call("forks the process"); }

/* The program's symbols come before those of libc, so a plugin that leaves by _exit, which runs no
 * handler, leaves by these. */
__attribute__((visibility("default"))) void _exit(int status)
{
    if (prepared != 0) on_exit_in_call();
    leave(status);
}

__attribute__((visibility("default"))) void _Exit(int status) { _exit(status); }

enum { SIGNAL_STACK = 1 << 16 };

void *crash_thread_begin(void)
{
    void *room = malloc(SIGNAL_STACK);
    const stack_t stack = {.ss_sp = room, .ss_size = SIGNAL_STACK};
    if (room != NULL) sigaltstack(&stack, NULL);
    enter_call();
    return room;
}

void crash_thread_end(void *stack)
{
    const stack_t none = {.ss_flags = SS_DISABLE};
    leave_call();
    sigaltstack(&none, NULL);
    free(stack);
}

void crash_thread_left(void *unused)
{
    (void)unused;
    on_exit_in_call();
}

/* On a stack of its own: a plugin may have used up the other. */
void crash_prepare(void)
{
    static char room[SIGNAL_STACK];
    const stack_t stack = {.ss_sp = room, .ss_size = sizeof room};
    struct sigaction action = {.sa_handler = on_crash, .sa_flags = SA_ONSTACK};
    prepared = getpid();
    enter_call();
    sigemptyset(&action.sa_mask);
    sigaltstack(&stack, NULL);
    const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; ++k) sigaction(fatal[k], &action, NULL);
    action.sa_handler = crash_interrupted;
    struct sigaction usual;
    if (sigaction(SIGQUIT, NULL, &usual) == 0 && usual.sa_handler != SIG_IGN)
        sigaction(SIGQUIT, &action, NULL);
    atexit(on_exit_in_call);
    at_quick_exit(on_exit_in_call);
    pthread_atfork(on_fork_in_call, NULL, NULL);
}
