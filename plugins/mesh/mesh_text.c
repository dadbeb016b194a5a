/* SPDX-FileCopyrightText: The Impinge authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "plugins/mesh/mesh_text.h"

#include <locale.h>

#define BLANKS " \t\v\f"

static bool append(mesh_text *text, size_t *used, const char *from, size_t length)
{
    if (text->capacity < *used + length + 1) {
        const size_t wanted = 2 * (*used + length + 64);
        char *grown = realloc(text->words, wanted);
        if (grown == NULL) return false;
        text->words = grown;
        text->capacity = wanted;
    }
    for (size_t k = 0; k < length; ++k) /* a NUL ends no line: it makes a word that is none */
        text->words[(*used)++] = (char)(from[k] != '\0' ? from[k] : '\1');
    text->words[*used] = '\0';
    return true;
}

/* One line of the file, without its end: "\n", "\r\n" or "\r". */
static const char *take_line(mesh_text *text, size_t *length)
{
    const char *from = text->at, *stop = from;
    while (stop < text->end && *stop != '\n' && *stop != '\r') ++stop;
    *length = (size_t)(stop - from);
    text->line += 1;
    if (stop + 1 < text->end && stop[0] == '\r' && stop[1] == '\n') ++stop;
    text->at = stop < text->end ? stop + 1 : stop;
    return from;
}

bool mesh_text_line(mesh_text *text, bool continues)
{
    while (text->at < text->end) {
        size_t used = 0;
        bool more = true;
        while (more && text->at < text->end) {
            size_t length;
            const char *from = take_line(text, &length);
            const char *comment = memchr(from, '#', length);
            if (comment != NULL) length = (size_t)(comment - from);
            more = continues && length > 0 && from[length - 1] == '\\';
            text->out_of_memory = !append(text, &used, from, length - more) ||
                                  !append(text, &used, " ", 1);
            if (text->out_of_memory) return false;
        }
        text->next = text->words;
        if (text->next[strspn(text->next, BLANKS)] != '\0') return true;
    }
    return false;
}

char *mesh_text_word(mesh_text *text)
{
    char *word = text->next + strspn(text->next, BLANKS);
    if (*word == '\0') return NULL;
    char *stop = word + strcspn(word, BLANKS);
    text->next = stop;
    if (*stop != '\0') {
        *stop = '\0';
        text->next = stop + 1;
    }
    return word;
}

enum { NUMBER_MAX = 100 };

bool mesh_text_number(const char *word, double *x)
{
    char copy[NUMBER_MAX], *end;
    if (strlen(word) >= sizeof copy || word[strspn(word, "+-.0123456789eE")] != '\0') return false;
    strcpy(copy, word);
    char *point = strchr(copy, '.');
    if (point != NULL) *point = *localeconv()->decimal_point;
    *x = strtod(copy, &end);
    return end != copy && *end == '\0' && isfinite(*x);
}

bool mesh_text_integer(const char *word, int64_t *k)
{
    const bool minus = *word == '-';
    const char *digits = word + (minus || *word == '+');
    const size_t length = strlen(digits);
    *k = 0;
    if (length == 0 || length > 15 || digits[strspn(digits, "0123456789")] != '\0') return false;
    for (; *digits != '\0'; ++digits) *k = 10 * *k + (*digits - '0');
    if (minus) *k = -*k;
    return true;
}

imp_status mesh_text_point(mesh_text *text, double x[3], triangles_fault *fault)
{
    for (int i = 0; i < 3; ++i) {
        const char *word = mesh_text_word(text);
        if (word == NULL)
            return triangles_refuse(fault, text->line, "a point of %d numbers, must have 3", i);
        if (!mesh_text_number(word, &x[i]))
            return triangles_refuse(fault, text->line, "'%.40s' is not a finite number", word);
    }
    return IMP_OK;
}

void mesh_text_clear(mesh_text *text) { free(text->words); }

imp_status mesh_text_status(const mesh_text *text)
{
    return text->out_of_memory ? IMP_INTERNAL : IMP_OK;
}

bool mesh_corners_add(mesh_corners *corners, int64_t k)
{
    if (corners->at == NULL || corners->count == corners->capacity) {
        const size_t wanted = corners->at == NULL ? 16 : 2 * corners->capacity;
        int64_t *grown = realloc(corners->at, wanted * sizeof *grown);
        if (grown == NULL) return false;
        corners->at = grown;
        corners->capacity = wanted;
    }
    corners->at[corners->count++] = k;
    return true;
}
