/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_PROGRESS_H
#define TOOLS_CLI_PROGRESS_H

/* The command begins now. */
void progress_begin(void);

/* How far a long answer has come: one line on standard error that is written over. Nothing is shown
 * in the command's first second, nor where standard error is no terminal. From any thread. */
void progress_show(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Takes the line away, so that what comes stands at its own beginning. */
void progress_wipe(void);

#endif
