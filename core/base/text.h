/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef CORE_BASE_TEXT_H
#define CORE_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Names and lines of text
 * =======================
 * Names from plugins and files are shown to people and written to JSON, so they have to be legal
 * and printable. */

#define TEXT_NAME_MAX 63 /* bytes of a type's, parameter's or plugin's name */

/* Whether the text is a name: 1 to 63 ASCII letters, digits, or characters of `extra`, a letter
 * first. NULL is not a name. */
bool text_is_name(const char *s, const char *extra);

bool text_is_utf8(const char *s);

/* Whether the text is a line: valid UTF-8 without control characters, fit for a terminal and for
 * JSON. NULL is not a line. */
bool text_is_line(const char *s);

/* Makes a line of any text, in place: control characters and broken UTF-8 become '?'. */
void text_clean(char *s);

/* Appends to the NUL-terminated text in buffer[size]; what does not fit is cut. */
void text_append(char *buffer, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Writes x as "%.15g" does in the C locale, in a fraction of its time, if x is 0, or at least 1e-4
 * in size and written without an exponent; it takes at most TEXT_SHORT characters and a final NUL.
 * False: it is neither, or -0, and nothing is written. */
enum { TEXT_SHORT = 24 };
bool text_fifteen_digits(char to[TEXT_SHORT + 1], double x);

/* Writes x as "%.15g" does. False: it takes more than size - 1 characters. */
bool text_of_fifteen(char *to, size_t size, double x);

/* Does what text_fifteen_digits does only where the text reads back as x. */
bool text_short_number(char to[TEXT_SHORT + 1], double x);

/* Writes the shortest decimal that reads back as x, with a point in every locale. */
typedef struct text_number {
    char at[32];
} text_number;
text_number text_of_number(double x);

/* Counts the characters (not bytes) in the first `bytes` bytes of UTF-8. */
size_t text_characters(const char *s, size_t bytes);

#endif
