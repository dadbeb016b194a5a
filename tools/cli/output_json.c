/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/cli/json_line.h"
#include "tools/cli/output.h"

/* JSON as a line: numbers in the fewest digits, no character that controls a terminal. */

/* Returns the next character that controls a terminal and that Jansson does not escape: DEL, or one
 * of C1 (U+0080 to U+009F), which is two bytes in UTF-8. NULL: there is none. */
static const char *next_control(const char *text)
{
    while ((text = strpbrk(text, "\x7f\xc2")) != NULL && *text == '\xc2' &&
           (unsigned char)text[1] >= 0xA0)
        text += 1;
    return text;
}

/* Copies the text with such characters written as \u009b; NULL: no memory. */
static char *escape_controls(const char *text)
{
    char *escaped = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&escaped, &length);
    if (out == NULL) return NULL;
    for (const char *control; (control = next_control(text)) != NULL;) {
        const bool single = *control == '\x7f';
        const unsigned code = single ? 0x7F : (unsigned char)control[1];
        fprintf(out, "%.*s\\u%04x", (int)(control - text), text, code);
        text = control + (single ? 1 : 2);
    }
    fputs(text, out);
    if (fclose(out) == 0) return escaped;
    free(escaped);
    return NULL;
}

char *output_json_line(json_t *object)
{
    char *text = json_line_text(object);
    json_decref(object);
    if (text == NULL) return NULL;
    if (next_control(text) == NULL) return text;
    char *escaped = escape_controls(text);
    free(text);
    return escaped;
}
