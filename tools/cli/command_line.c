/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */
#include <config.h>

#include <stdlib.h>
#include <string.h>

#include "tools/cli/command_line.h"

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

/* Copies the word that begins at `typed` to *to, NUL-terminated; returns where it ends in
 * `typed`. */
static const char *copy_word(const char *typed, char **to, char *quote)
{
    *quote = '\0';
    for (; *typed != '\0' && (*quote != '\0' || !is_blank(*typed)); ++typed) {
        if (*quote == '\0' && (*typed == '\'' || *typed == '"')) {
            *quote = *typed;
        } else if (*typed == *quote) {
            *quote = '\0';
        } else {
            if (*typed == '\\' && *quote != '\'' && typed[1] != '\0') ++typed;
            *(*to)++ = *typed;
        }
    }
    *(*to)++ = '\0';
    return typed;
}

bool command_line_split(const char *typed, command_line *line)
{
    /* A word has at least one byte, and a blank before all but the first: there is space for each
     * NUL. */
    const size_t length = strlen(typed);
    *line = (command_line){.text = malloc(length + 2),
                           .words = calloc(length / 2 + 2, sizeof *line->words)};
    if (line->text == NULL || line->words == NULL) return false;
    char *to = line->text, quote;
    do {
        while (is_blank(*typed)) ++typed;
        line->words[line->count++] = to;
        typed = copy_word(typed, &to, &quote);
    } while (*typed != '\0');
    line->is_quoted = quote != '\0';
    return true;
}

void command_line_free(command_line *line)
{
    free(line->words);
    free(line->text);
    *line = (command_line){0};
}
