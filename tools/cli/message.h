/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef TOOLS_CLI_MESSAGE_H
#define TOOLS_CLI_MESSAGE_H

#include <impinge/impinge.h>

/* Exit statuses and error messages of the command
 * ===============================================
 * Results go to standard output, complaints to standard error, one line each:
 *
 *   impinge: pair: --gamma must be a number greater than 0, not '-1'
 *
 * A complaint states what was found and what is allowed. Every function that complains returns the
 * matching exit status, so that callers write `return complain(...)`. */

/* Exit statuses: a contract with scripts. If several apply, the greatest is used. */
typedef enum exit_status {
    EXIT_ANSWERED = 0,
    EXIT_CONTACT = 1, /* with --exit-code only */
    EXIT_USAGE = 2,
    EXIT_UNDECIDED = 3,
    EXIT_DATA = 4, /* scene or data wrong, file not readable or writable, out of memory */
    EXIT_PLUGIN = 5,
    EXIT_CONFORMANCE = 6
} exit_status;

/* A text with its control characters, C1 included, and bytes that are no UTF-8 written as \x1b, so
 * that names of files neither forge lines nor steer a terminal; a line break is \n. Text that is
 * too long is cut. [async-signal-safe] */
typedef struct message_text {
    char text[4096];
} message_text;
message_text message_shown(const char *text);

/* Returns the exit status for an error of the library. */
exit_status status_of_code(imp_code code);

/* Switches complaints off and on: if several processes find the same fault, one complains and the
 * others only return the status. */
void complain_aloud(bool aloud);

/* Writes "impinge: VERB: text" (or "impinge: text" where verb is NULL) and returns `status`.
 * Control characters in the text are escaped. */
exit_status complain(exit_status status, const char *verb, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Writes a line like complain, for warnings that are no errors. */
void remark(const char *verb, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Returns the text of the first complaint with another status than 0 or 1, or NULL: with --json it
 * becomes the object {"error": text} (output_error_object). What is said beside an answer that was
 * printed is a remark, not a complaint. */
const char *complain_first(void);

/* Returns the text of an error; if it has none, that of its code. */
const char *message_of(const imp_error *error);

/* Complains of an error of the library and returns its status. */
exit_status complain_of(const imp_error *error, const char *verb);

/* Complains of memory that ran out in the command itself, and returns EXIT_DATA. */
exit_status complain_of_memory(const char *verb);

#endif
