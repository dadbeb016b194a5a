/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include "core/base/place.h"
#include "core/base/text.h"

#include <stdio.h>

#define PLACE_TEXT 400 /* bytes: leaves room for the message in imp_error.text */

place place_document(const char *name) { return (place){.key = name, .document = true}; }

place place_argument(const place *up, const char *name)
{
    return (place){.up = up, .key = name, .argument = true};
}

place place_named(const place *up, const char *noun, const char *name)
{
    return (place){.up = up, .key = name, .argument = true, .noun = noun};
}

place place_counted(const place *up, const char *noun, size_t index)
{
    return (place){.up = up, .index = index, .argument = true, .noun = noun};
}

place place_key(const place *up, const char *key) { return (place){.up = up, .key = key}; }

place place_index(const place *up, size_t index) { return (place){.up = up, .index = index}; }

/* RFC 6901: in a pointer, '~' is written ~0 and '/' is written ~1. */
static void append_key(char *text, const char *key)
{
    for (; *key; ++key) {
        if (*key == '~')
            text_append(text, PLACE_TEXT, "~0");
        else if (*key == '/')
            text_append(text, PLACE_TEXT, "~1");
        else
            text_append(text, PLACE_TEXT, "%c", *key);
    }
}

static void append_place(char *text, const place *at)
{
    if (at->up != NULL) append_place(text, at->up);
    if (at->up != NULL) {
        const char *joint = at->up->document ? ": /" : at->up->argument ? ": " : "/";
        text_append(text, PLACE_TEXT, "%s", joint);
    }
    if (at->noun != NULL && at->key != NULL)
        text_append(text, PLACE_TEXT, "%s '%.80s'", at->noun, at->key);
    else if (at->noun != NULL)
        text_append(text, PLACE_TEXT, "%s %zu", at->noun, at->index);
    else if (at->key == NULL)
        text_append(text, PLACE_TEXT, "%zu", at->index);
    else if (at->document || at->argument)
        text_append(text, PLACE_TEXT, "%s", at->key);
    else
        append_key(text, at->key);
}

imp_code place_error(const place *at, imp_error *error, imp_code code, const char *format, ...)
{
    if (error == NULL) return code;
    char text[PLACE_TEXT] = "";
    append_place(text, at);
    va_list arguments;
    va_start(arguments, format);
    error_set_v(error, code, format, arguments);
    va_end(arguments);
    error_prefix(error, "%s", text);
    text_clean(error->text);
    return code;
}
