/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "crash.h"

#include <impinge/impinge.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "message.h"

/* Only calls that are safe in a signal handler. */
static void say(const char *text)
{
    const ssize_t written = write(STDERR_FILENO, text, strlen(text));
    (void)written;
}

static void blame(const char *type, const char *callback, const char *what)
{
    say("impinge: type '");
    say(type);
    say("' ");
    say(what);
    say(" in its ");
    say(callback);
    say("; `impinge check` tells more, --isolate runs it in a process of its own\n");
    _exit(EXIT_PLUGIN);
}

static void on_crash(int number)
{
    const char *callback, *type = imp_call_in_progress(&callback);
    if (type != NULL) blame(type, callback, "crashes");
    signal(number, SIG_DFL);
    raise(number);
}

static void on_exit_in_call(void)
{
    const char *callback, *type = imp_call_in_progress(&callback);
    if (type != NULL) blame(type, callback, "ends the process");
}

/* On a stack of its own: a plugin may have used up the other. */
void crash_prepare(void)
{
    static char room[1 << 16];
    const stack_t stack = {.ss_sp = room, .ss_size = sizeof room};
    struct sigaction action = {.sa_handler = on_crash, .sa_flags = SA_ONSTACK};
    sigemptyset(&action.sa_mask);
    sigaltstack(&stack, NULL);
    const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t k = 0; k < sizeof fatal / sizeof *fatal; ++k) sigaction(fatal[k], &action, NULL);
    atexit(on_exit_in_call);
}
