/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_CRASH_H
#define TOOLS_CLI_CRASH_H

/* When a plugin crashes or exits in the middle of its work, the command says which one and in what
 * callback, and ends with EXIT_PLUGIN. A crash of our own stays what it is. */
void crash_prepare(void);

/* A handler for signals by which the user ends the command: says in whose callbacks the threads are, in
 * case one hangs, and lets the signal end the process. SIGQUIT has it from the beginning,
 * unless it is ignored. */
void crash_interrupted(int number);

/* The same for a thread of our own: its stack for signals (NULL: no memory, and a plugin that uses
 * up the thread's stack ends the process without a message), to be handed to crash_thread_end. */
void *crash_thread_begin(void);
void crash_thread_end(void *stack);

/* A cleanup handler of the thread (pthread_cleanup_push): a plugin has ended it. */
void crash_thread_left(void *unused);

#endif
