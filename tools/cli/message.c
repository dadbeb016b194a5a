/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/message.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

exit_status status_of_code(imp_code code)
{
    switch (code) {
    case IMP_SUCCESS:
        return EXIT_ANSWERED;
    case IMP_ERROR_USAGE:
        return EXIT_USAGE;
    case IMP_ERROR_PLUGIN:
        return EXIT_PLUGIN;
    case IMP_ERROR_SCENE:
    case IMP_ERROR_FILE:
    case IMP_ERROR_MEMORY:
        return EXIT_DATA;
    case IMP_ERROR_LIMIT:
        return EXIT_UNDECIDED;
    }
    return EXIT_DATA;
}

/* Bytes that follow the first in a character of UTF-8; -1: no character begins so. */
static int bytes_after(unsigned char first)
{
    if (first < 0x80) return 0;
    if (first < 0xC2 || first > 0xF4) return -1;
    return first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
}

/* Bytes of the character that can be shown as it is; 0: it is none. */
static size_t shown_length(const unsigned char *c)
{
    const int after = bytes_after(c[0]);
    if (c[0] < 0x20 || c[0] == 0x7F || after < 0) return 0;
    if (c[0] == 0xC2 && c[1] < 0xA0) return 0; /* C1 */
    for (int k = 1; k <= after; ++k)
        if ((c[k] & 0xC0) != 0x80) return 0;
    return (size_t)after + 1;
}

message_text message_shown(const char *text)
{
    static const char digits[] = "0123456789abcdef";
    message_text shown;
    size_t used = 0;
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0';) {
        const size_t length = shown_length(c);
        if (used + 5 > sizeof shown.text) break;
        if (length > 0) {
            memcpy(shown.text + used, c, length);
            used += length;
        } else if (*c == '\n') {
            memcpy(shown.text + used, "\\n", 2);
            used += 2;
        } else {
            const char escape[4] = {'\\', 'x', digits[*c >> 4], digits[*c & 15]};
            memcpy(shown.text + used, escape, sizeof escape);
            used += sizeof escape;
        }
        c += length > 0 ? length : 1;
    }
    shown.text[used] = '\0';
    return shown;
}

static bool silent;

void complain_aloud(bool aloud) { silent = !aloud; }

enum { TEXT = 2048 };

/* Global, like standard error. */
static char first_error[TEXT];

const char *complain_first(void) { return first_error[0] != '\0' ? first_error : NULL; }

static bool is_answer(exit_status status)
{
    return status == EXIT_ANSWERED || status == EXIT_CONTACT;
}

static void say(const char *verb, const char *text)
{
    fprintf(stderr, "impinge: %s%s%s\n", verb != NULL ? verb : "", verb != NULL ? ": " : "",
            message_shown(text).text);
}

exit_status complain(exit_status status, const char *verb, const char *format, ...)
{
    char text[TEXT];
    va_list list;
    if (silent) return status;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (!is_answer(status) && first_error[0] == '\0') memcpy(first_error, text, sizeof text);
    say(verb, text);
    return status;
}

void remark(const char *verb, const char *format, ...)
{
    char text[TEXT];
    va_list list;
    if (silent) return;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    say(verb, text);
}

const char *message_of(const imp_error *error)
{
    return error->text[0] != '\0' ? error->text : imp_code_text(error->code);
}

exit_status complain_of(const imp_error *error, const char *verb)
{
    return complain(status_of_code(error->code), verb, "%s", message_of(error));
}

exit_status complain_of_memory(const char *verb)
{
    return complain(EXIT_DATA, verb, "%s", imp_code_text(IMP_ERROR_MEMORY));
}
