/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CRASH_H
#define TOOLS_CLI_CRASH_H

#include <stdbool.h>

/* When a plugin crashes, also in a thread that it has left, or exits in the middle of its work, the
 * command says which one and in what callback, and ends with EXIT_PLUGIN; with `json` also by an
 * object {"error": text} on standard output. A crash anywhere else ends the process by its
 * signal. */
void crash_prepare(bool json);

/* Ends the process, from a signal handler too, in whatever callback it is: prints the text as
 * complain does. Precondition: it has no control characters. */
_Noreturn void crash_end_with(const char *text, int status);

/* A handler for signals by which the user ends the command: prints in which callbacks the threads
 * are, in case one hangs, and lets the signal end the process. crash_prepare installs it for
 * SIGQUIT, unless that is ignored. */
void crash_interrupted(int number);

/* Prepares one of our threads for crashes. Returns its signal stack, to be passed to
 * crash_thread_end; NULL: no memory, and a plugin that exhausts the thread's stack ends the process
 * without a message. */
void *crash_thread_begin(void);
void crash_thread_end(void *stack);

/* A cleanup handler of the thread (pthread_cleanup_push): a plugin has ended it. */
void crash_thread_left(void *unused);

#endif
