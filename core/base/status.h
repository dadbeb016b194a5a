/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_STATUS_H
#define CORE_BASE_STATUS_H

#include <stdarg.h>

#include <impinge/impinge.h>

/* Errors on their way to the caller
 * =================================
 * A function that can fail takes an imp_error (perhaps NULL) and answers an imp_code. It
 * says what went wrong once, where it is known best, by error_set; those above add the place. */

#define STATUS_PRINTF_(text, first) __attribute__((format(printf, text, first)))

/* Writes code and text, and answers `code`, so that a failure is one statement:
 *     return error_set(error, IMP_ERROR_FILE, "%s: no such file", path);
 * A text too long is cut between characters of UTF-8. Neither allocates nor touches errno. */
imp_code error_set(imp_error *error, imp_code code, const char *format, ...) STATUS_PRINTF_(3, 4);
imp_code error_set_v(imp_error *error, imp_code code, const char *format, va_list arguments)
    STATUS_PRINTF_(3, 0);

/* Puts a place before the text there is: "<place>: <text>". For the levels above. */
void error_prefix(imp_error *error, const char *format, ...) STATUS_PRINTF_(2, 3);

/* IMP_ERROR_USAGE: a function of the public header needs an argument that is NULL. */
imp_code error_set_missing(imp_error *error, const char *function);

/* Sets the one text for memory that ran out. */
imp_code error_set_memory(imp_error *error);

#endif
