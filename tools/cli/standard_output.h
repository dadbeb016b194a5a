/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_STANDARD_OUTPUT_H
#define TOOLS_CLI_STANDARD_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>

/* A standard output that plugins cannot reach
 * ===========================================
 * A plugin runs in this process and may print. What it writes to descriptor 1, or prints while one
 * of its callbacks runs, goes to standard error; what a copy of the process prints (a plugin may
 * fork) is dropped. The command prints with stdio as usual: `stdout` then collects its text, which
 * goes to a private copy of descriptor 1. A signal or a slow reader interrupts no write. Whatever a
 * plugin closes, text that is lost is an error. */

/* False: no memory. */
bool standard_output_prepare(void);

/* Redirects the text to that file; the caller may then close the descriptor. False: see errno. */
bool standard_output_replace(int descriptor);

/* Writes the collected text. False, with errno: this write failed, or an earlier one that was not
 * reported yet. */
bool standard_output_flush(void);

/* Whether standard_output_replace was called, so that the text goes to a file. */
bool standard_output_is_replaced(void);

/* Writes the text at once, and drops the collected text: a process that crashes prints nothing
 * else. [async-signal-safe] */
void standard_output_write_at_crash(const char *text, size_t length);

bool standard_output_is_terminal(void);

/* Drops the collected text. */
void standard_output_discard(void);

/* Flushes and closes. */
bool standard_output_close(void);

#endif
