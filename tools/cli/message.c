/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "tools/cli/message.h"

#include <stdarg.h>
#include <stdio.h>

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
    }
    return EXIT_DATA;
}

static void hide_control_characters(char *text)
{
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c < 0x20 || c == 0x7F) *text = '?';
    }
}

static bool silent;

void complain_aloud(bool aloud) { silent = !aloud; }

exit_status complain(exit_status status, const char *verb, const char *format, ...)
{
    char text[2048];
    va_list list;
    if (silent) return status;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    hide_control_characters(text);
    fprintf(stderr, "impinge: %s%s%s\n", verb != NULL ? verb : "", verb != NULL ? ": " : "", text);
    return status;
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
