/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/status.h"
#include "core/common/c_locale.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

const char *imp_version(void) { return "libimpinge " PACKAGE_VERSION; }

const char *imp_code_text(imp_code code)
{
    switch (code) {
    case IMP_SUCCESS:
        return "success";
    case IMP_ERROR_USAGE:
        return "wrong usage";
    case IMP_ERROR_SCENE:
        return "wrong scene";
    case IMP_ERROR_PLUGIN:
        return "plugin error";
    case IMP_ERROR_FILE:
        return "file cannot be read or written";
    case IMP_ERROR_MEMORY:
        return "out of memory";
    case IMP_ERROR_LIMIT:
        return "limit reached";
    }
    return "unknown code";
}

/* A text that fills the buffer may have been cut within a character of UTF-8: drops the
 * bytes of the last character if it is not whole. */
static void end_at_character(char *text, size_t size)
{
    size_t end = strlen(text);
    if (end + 1 < size) return;
    size_t lead = end;
    while (lead > 0 && ((unsigned char)text[lead - 1] & 0xC0) == 0x80) --lead;
    if (lead == 0) return;
    unsigned char first = (unsigned char)text[lead - 1];
    size_t need = first < 0x80 ? 0 : first < 0xE0 ? 1 : first < 0xF0 ? 2 : 3;
    if (end - lead < need) text[lead - 1] = '\0';
}

imp_code error_set_v(imp_error *error, imp_code code, const char *format, va_list arguments)
{
    if (error == NULL) return code;
    int saved = errno;
    error->code = code;
    error->text[0] = '\0';
    const c_locale locale = c_locale_enter();
    vsnprintf(error->text, sizeof error->text, format, arguments);
    c_locale_leave(&locale);
    end_at_character(error->text, sizeof error->text);
    errno = saved;
    return code;
}

imp_code error_set(imp_error *error, imp_code code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_set_v(error, code, format, arguments);
    va_end(arguments);
    return code;
}

void error_prefix(imp_error *error, const char *format, ...)
{
    if (error == NULL) return;
    imp_error place;
    va_list arguments;
    va_start(arguments, format);
    error_set_v(&place, error->code, format, arguments);
    va_end(arguments);
    imp_error old = *error;
    error_set(error, old.code, "%s: %s", place.text, old.text);
}

imp_code error_set_missing(imp_error *error, const char *function)
{
    return error_set(error, IMP_ERROR_USAGE, "%s: an argument is NULL", function);
}

imp_code error_set_memory(imp_error *error)
{
    return error_set(error, IMP_ERROR_MEMORY, "out of memory");
}
